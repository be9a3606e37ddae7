// Bricks that may hold a voxel centre within `reach` of some vertex of V_t: all that meet the box V_t(u) +- reach.
// One work-item: one pixel.
//   vertices pixels x float4, world, w = 0: no surface
//   stamps   slots, in/out: frame number in which the slot was last listed, so that it is listed once
//   touched  slots, out: slots[0 .. counts[0])
//   missing  capacity x int4, out: positions of bricks that do not exist, with repetitions; counts[1] of them, of which
//            those beyond the capacity are not stored
#include "core/fusion/kernels/brick_lookup.clh"

kernel void list_touched_bricks(global const float4* vertices, const int pixels, global const BrickEntry* table,
                                const uint mask, const float reach, const float bricks_per_metre,
                                const int frame_stamp, volatile global int* stamps, volatile global int* counts,
                                global int* touched, global int4* missing, const int missing_capacity) {
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
        const int slot = find_brick(table, mask, x, y, z);
        if (slot == BRICK_NONE) {
          const int n = atomic_inc(counts + 1);
          if (n < missing_capacity) missing[n] = (int4)(x, y, z, 0);
        } else if (stamps[slot] != frame_stamp && atomic_xchg(stamps + slot, frame_stamp) != frame_stamp) {
          touched[atomic_inc(counts)] = slot;
        }
      }
    }
  }
}
