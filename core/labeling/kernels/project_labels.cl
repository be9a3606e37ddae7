// Projection of the label cloud to the current view (thesis 3.3.3):
//   S_prj,t(u) = raw label of voxel floor(V_t(u) / voxel_size)
// One work-item: one pixel.
//   vertices  pixels x float4, world, w = 0: no surface
//   labels    slots x 512 label voxels
//   projected pixels, out: raw label or 0
#include "core/fusion/kernels/brick_lookup.clh"
#include "core/labeling/kernels/label_voxel.h"

kernel void project_labels(global const float4* vertices, const int pixels, global const BrickEntry* table,
                           const uint mask, global const uint* labels, const float voxels_per_metre,
                           global uint* projected) {
  const int i = get_global_id(0);
  if (i >= pixels) return;
  const float4 v = vertices[i];
  uint label = 0;
  if (v.w > 0.0f) {
    const int x = (int)floor(v.x * voxels_per_metre);
    const int y = (int)floor(v.y * voxels_per_metre);
    const int z = (int)floor(v.z * voxels_per_metre);
    const int slot = find_brick(table, mask, x >> BRICK_SHIFT, y >> BRICK_SHIFT, z >> BRICK_SHIFT);
    if (slot != BRICK_NONE) {
      const int local_index = (x & 7) + 8 * ((y & 7) + 8 * (z & 7));
      label = LABEL_OF(labels[slot * BRICK_VOXELS + local_index]);
    }
  }
  projected[i] = label;
}
