#include "core/compute/kernels/lanes.clh"
#include "core/fusion/kernels/brick_band.clh"

// Lists the missing bricks of the groups of pixels that find_missing_bricks marked: (x, y, z, 0) counted from the window's first
// brick. Order is arbitrary; a brick appears once, or rarely more than once (when the set is full or the brick lies more
// than 512 bricks off).
//
// One work-item: one group. Usually no group is marked.
// Arguments as in find_missing_bricks, but T_window_camera: camera metres to bricks of the window. list: capacity; count[0]:
// bricks found, also those beyond capacity. seen: set of SEEN_SIZE keys, 0 = free; zeroed before the launch.
#define SEEN_SIZE 32768
#define SEEN_PROBES 32

inline void list_brick(const int x, const int y, const int z, global uint* seen, global int4* list, const int capacity,
                       global int* count) {
  const int bx = x + 512;
  const int by = y + 512;
  const int bz = z + 512;
  if (((bx | by | bz) >> 10) == 0) {
    const uint key = (uint)(bx | (by << 10) | (bz << 20)) | 0x80000000u;
    uint i = brick_hash(x, y, z);
    for (int probe = 0; probe < SEEN_PROBES; ++probe, ++i) {
      const uint found = atomic_cmpxchg(&seen[i & (SEEN_SIZE - 1)], 0u, key);
      if (found == key) return;
      if (found == 0u) break;
    }
  }
  const int position = atomic_inc(count);
  if (position < capacity) list[position] = (int4)(x, y, z, 0);
}

kernel void list_missing_bricks(global const float* depth_m, const int width, const int height, const float4 K,
                                const float16 T_window_camera, const float truncation_m, const float2 depth_range,
                                global const int* cells, global const int* page_slots, const int4 window_size,
                                const int crossings, global const uchar* missing, global uint* seen,
                                global int4* list, const int capacity, global int* count) {
  const int group = (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  const int groups = (width + LANES - 1) / LANES;
  if (group >= groups || v >= height || !missing[v * groups + group]) return;
  for (int u = LANES * group; u < min(LANES * group + LANES, width); ++u) {
    const float z = depth_m[v * width + u];
    if (!(z >= depth_range.x && z <= depth_range.y)) continue;
    const Band b = band_of_pixel(K, T_window_camera, (float)u, (float)v, z - truncation_m, z + truncation_m);
    for (int candidate = 0; candidate <= 3 * crossings; ++candidate) {
      const int axis = candidate == 0 ? 3 : (candidate - 1) % 3;
      const int k = (candidate + 2) / 3;
      const float a = axis == 0 ? b.ax : axis == 1 ? b.ay : b.az;
      const float d = axis == 0 ? b.dx : axis == 1 ? b.dy : b.dz;
      int brick = 0;
      float t = 0.0f;
      if (axis < 3) {
        t = band_crossing(a, d, k, &brick);
        if (!(t > 0.0f && t <= 1.0f)) continue;
      }
      const int x = axis == 0 ? brick : (int)floor(b.ax + t * b.dx);
      const int y = axis == 1 ? brick : (int)floor(b.ay + t * b.dy);
      const int z_brick = axis == 2 ? brick : (int)floor(b.az + t * b.dz);
      if (window_slot(cells, page_slots, window_size, x, y, z_brick) < 0) {
        list_brick(x, y, z_brick, seen, list, capacity, count);
      }
    }
  }
}
