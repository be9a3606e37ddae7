// Normals of the surface that has been seen at least `settled` (TsdfVoxel::weight) at its voxel; elsewhere all 0. counts: pixels
// with surface that has not, and with surface; both are added to.
// One work-item: LANES pixels, one after the other. vertices: world, w = 0: no surface. voxels: slots x 512 TsdfVoxel as uint
// (weight high).
#include "core/fusion/kernels/brick_lookup.clh"

kernel void leave_out_fresh(global const float4* vertices, global const float4* normals, const int pixels,
                            global const BrickEntry* table, const uint table_mask, global const uint* voxels,
                            const float voxels_per_metre, const uint settled, global float4* settled_normals,
                            volatile global int* counts) {
  const int first = LANES * (int)get_global_id(0);
  const int count = min(LANES, pixels - first);
  KnownBrick known = no_brick_known();
  // First where all of them are, then what is there: so the memory is waited for once.
  int places[LANES];
  int with_surface = 0;
  for (int i = 0; i < count; ++i) {
    const float4 vertex = vertices[first + i];
    const int3 v = convert_int3(floor(vertex.xyz * voxels_per_metre));
    const int slot = vertex.w > 0.0f ? find_near(&known, table, table_mask, v.x >> BRICK_SHIFT, v.y >> BRICK_SHIFT,
                                                 v.z >> BRICK_SHIFT)
                                     : BRICK_NONE;
    with_surface += vertex.w > 0.0f ? 1 : 0;
    places[i] = slot == BRICK_NONE ? -1 : slot * BRICK_VOXELS + (v.x & 7) + 8 * ((v.y & 7) + 8 * (v.z & 7));
  }
  int settled_here = 0;
  for (int i = 0; i < count; ++i) {
    const bool is_settled = places[i] >= 0 && (voxels[places[i]] >> 16) >= settled;
    settled_normals[first + i] = is_settled ? normals[first + i] : (float4)(0.0f);
    settled_here += is_settled ? 1 : 0;
  }
  const int fresh = with_surface - settled_here;
  if (fresh > 0) atomic_add(counts, fresh);
  if (with_surface > 0) atomic_add(counts + 1, with_surface);
}
