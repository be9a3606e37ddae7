// Bricks that do not exist but may hold a voxel centre within `reach` of some vertex of V_t: those that meet the box
// V_t(u) +- reach. One work-item: LANES pixels, one after the other.
//   vertices pixels x float4, world, w = 0: no surface
//   missing  capacity x int4, out: positions, with repetitions
//   count    out: how many; those beyond the capacity are not stored
#include "core/fusion/kernels/brick_lookup.clh"

kernel void list_uncovered_bricks(global const float4* vertices, const int pixels, global const BrickEntry* table,
                                const uint mask, const float reach, const float bricks_per_metre,
                                volatile global int* count, global int4* missing, const int capacity) {
  const int first = LANES * (int)get_global_id(0);
  const int end = min(first + LANES, pixels);
  int3 low = (int3)(INT_MAX), high = low; /* of the box that was looked at last: its neighbour's is mostly the same */
  for (int i = first; i < end; ++i) {
    const float4 v = vertices[i];
    if (!(v.w > 0.0f)) continue;
    const int3 low_here = convert_int3(floor((v.xyz - reach) * bricks_per_metre));
    const int3 high_here = convert_int3(floor((v.xyz + reach) * bricks_per_metre));
    if (all(low_here == low) && all(high_here == high)) continue;
    low = low_here;
    high = high_here;
    for (int z = low.z; z <= high.z; ++z) {
      for (int y = low.y; y <= high.y; ++y) {
        for (int x = low.x; x <= high.x; ++x) {
          if (find_brick(table, mask, x, y, z) != BRICK_NONE) continue;
          const int n = atomic_inc(count);
          if (n < capacity) missing[n] = (int4)(x, y, z, 0);
        }
      }
    }
  }
}
