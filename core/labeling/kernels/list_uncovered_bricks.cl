// Bricks that do not exist but may hold a voxel centre within `reach` of some vertex of V_t: those that meet the box
// V_t(u) +- reach. One work-item: one pixel.
//   vertices pixels x float4, world, w = 0: no surface
//   missing  capacity x int4, out: positions, with repetitions
//   count    out: how many; those beyond the capacity are not stored
#include "core/fusion/kernels/brick_lookup.clh"

kernel void list_uncovered_bricks(global const float4* vertices, const int pixels, global const BrickEntry* table,
                                const uint mask, const float reach, const float bricks_per_metre,
                                volatile global int* count, global int4* missing, const int capacity) {
  const int i = get_global_id(0);
  if (i >= pixels) return;
  const float4 v = vertices[i];
  if (!(v.w > 0.0f)) return;
  const int x0 = (int)floor((v.x - reach) * bricks_per_metre), x1 = (int)floor((v.x + reach) * bricks_per_metre);
  const int y0 = (int)floor((v.y - reach) * bricks_per_metre), y1 = (int)floor((v.y + reach) * bricks_per_metre);
  const int z0 = (int)floor((v.z - reach) * bricks_per_metre), z1 = (int)floor((v.z + reach) * bricks_per_metre);
  for (int z = z0; z <= z1; ++z) {
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        if (find_brick(table, mask, x, y, z) != BRICK_NONE) continue;
        const int n = atomic_inc(count);
        if (n < capacity) missing[n] = (int4)(x, y, z, 0);
      }
    }
  }
}
