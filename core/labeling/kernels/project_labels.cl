// Projection of the label cloud to the current view (thesis 3.3.3):
//   S_prj,t(u) = raw label of voxel floor(V_t(u) / voxel_size)
// One work-item: LANES pixels, one after the other.
//   vertices  pixels x float4, world, w = 0: no surface
//   labels    slots x 512 label voxels
//   projected pixels, out: raw label or 0
#include "core/fusion/kernels/brick_lookup.clh"
#include "core/labeling/kernels/label_voxel.h"

kernel void project_labels(global const float4* vertices, const int pixels, global const BrickEntry* table,
                           const uint mask, global const uint* labels, const float voxels_per_metre,
                           global uint* projected) {
  const int first = LANES * (int)get_global_id(0);
  const int count = min(LANES, pixels - first);
  KnownBrick known = no_brick_known();
  // First where all of them are, then what is there: so the memory is waited for once.
  int places[LANES];
  for (int i = 0; i < count; ++i) {
    const float4 v = vertices[first + i];
    const int x = (int)floor(v.x * voxels_per_metre);
    const int y = (int)floor(v.y * voxels_per_metre);
    const int z = (int)floor(v.z * voxels_per_metre);
    const int slot = v.w > 0.0f
                         ? find_near(&known, table, mask, x >> BRICK_SHIFT, y >> BRICK_SHIFT, z >> BRICK_SHIFT)
                         : BRICK_NONE;
    places[i] = slot == BRICK_NONE ? -1 : slot * BRICK_VOXELS + (x & 7) + 8 * ((y & 7) + 8 * (z & 7));
  }
  for (int i = 0; i < count; ++i) projected[first + i] = places[i] < 0 ? 0u : LABEL_OF(labels[places[i]]);
}
