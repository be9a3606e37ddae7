#include "core/fusion/kernels/brick_band.clh"

// missing(u, v) = 1 if the band around the depth reading of pixel (u, v) touches a brick that does not exist yet, else 0.
//
// One work-item: one pixel. Straight-line code so that PoCL vectorises it over work-items.
// depth_m: width * height, metres, anything outside of [depth_range.x, depth_range.y] is no reading.
// missing: width * height and more. cells, page_slots, window_size: see brick_window.clh.
// T_window_camera: camera metres to bricks from the window's first.
kernel void find_missing_bricks(global const float* restrict depth_m, const int width, const int height,
                                const float4 K, const float16 T_window_camera, const float truncation_m,
                                const float2 depth_range, global const int* restrict cells,
                                global const int* restrict page_slots, const int4 window_size,
                                global uchar* restrict missing) {
  const int u = (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  if (u >= width || v >= height) return;
  const float reading = depth_m[v * width + u];
  const int valid = (reading >= depth_range.x) & (reading <= depth_range.y);
  const float z = valid ? reading : depth_range.x;
  const Band b = band_of_pixel(K, T_window_camera, (float)u, (float)v, z - truncation_m, z + truncation_m);

  int any = window_slot(cells, page_slots, window_size, (int)floor(b.ax), (int)floor(b.ay), (int)floor(b.az)) < 0;
#pragma unroll
  for (int k = 1; k <= BAND_CROSSINGS; ++k) {
    int brick;
    float t = band_crossing(b.ax, b.dx, k, &brick);
    t = t <= 1.0f ? t : 0.0f;
    int hit = t > 0.0f;
    int slot = window_slot(cells, page_slots, window_size, brick, (int)floor(b.ay + t * b.dy),
                           (int)floor(b.az + t * b.dz));
    any |= hit & (slot < 0);

    t = band_crossing(b.ay, b.dy, k, &brick);
    t = t <= 1.0f ? t : 0.0f;
    hit = t > 0.0f;
    slot = window_slot(cells, page_slots, window_size, (int)floor(b.ax + t * b.dx), brick,
                       (int)floor(b.az + t * b.dz));
    any |= hit & (slot < 0);

    t = band_crossing(b.az, b.dz, k, &brick);
    t = t <= 1.0f ? t : 0.0f;
    hit = t > 0.0f;
    slot = window_slot(cells, page_slots, window_size, (int)floor(b.ax + t * b.dx), (int)floor(b.ay + t * b.dy),
                       brick);
    any |= hit & (slot < 0);
  }
  missing[v * width + u] = (uchar)(valid & any);
}
