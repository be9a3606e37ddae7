// Normals of the surface that has been seen at least `settled` (TsdfVoxel::weight) at its voxel; elsewhere all 0. counts: pixels
// with surface that has not, and with surface; both are added to.
// One work-item: one pixel. vertices: world, w = 0: no surface. voxels: slots x 512 TsdfVoxel as uint (weight high).
#include "core/fusion/kernels/brick_lookup.clh"

kernel void leave_out_fresh(global const float4* vertices, global const float4* normals, const int pixels,
                            global const BrickEntry* table, const uint table_mask, global const uint* voxels,
                            const float voxels_per_metre, const uint settled, global float4* settled_normals,
                            volatile global int* counts) {
  const int i = (int)get_global_id(0);
  if (i >= pixels) return;
  settled_normals[i] = (float4)(0.0f);
  const float4 vertex = vertices[i];
  if (!(vertex.w > 0.0f)) return;
  atomic_inc(counts + 1);
  const int3 v = convert_int3(floor(vertex.xyz * voxels_per_metre));
  const int slot = find_brick(table, table_mask, v.x >> BRICK_SHIFT, v.y >> BRICK_SHIFT, v.z >> BRICK_SHIFT);
  const uint weight = slot == BRICK_NONE
                          ? 0u
                          : voxels[slot * BRICK_VOXELS + (v.x & 7) + 8 * ((v.y & 7) + 8 * (v.z & 7))] >> 16;
  if (weight >= settled)
    settled_normals[i] = normals[i];
  else
    atomic_inc(counts);
}
