// Mirrored and scaled copies of the queries (Torralba et al. 2008, warping).
//   w(x) = (x - c) * scale * mirror + c, c = 15.5, scale = 230, 256 or 282 of 256, mirror = 1 or -1 (x only)
//   copy(x) = query(w(x)), bilinear in fixed point (512ths of a pixel), 0 outside, rounded half up
// Integers throughout: every device gives the same bytes.
#include "core/catalogue/kernels/thumbnail_layout.h"

inline int pixel_or_zero(global const char* plane, const int y, const int x) {
  const int inside = x >= 0 && y >= 0 && x < FINE_SIDE && y < FINE_SIDE;
  return inside ? (int)plane[y * FINE_SIDE + x] : 0;
}

// One work-item: pixel (x, y) of plane c of one variant; global = (32, 3 * 32, queries * 6).
// queries: [query][3][32][32]; fine: [query][variant][3][40][40], the border is not written.
kernel void warp_queries(global const char* queries, global char* fine, const int query_count) {
  const int x = get_global_id(0), row = get_global_id(1), copy = get_global_id(2);
  if (x >= FINE_SIDE || row >= 3 * FINE_SIDE || copy >= query_count * THUMBNAIL_VARIANTS) return;
  const int c = row / FINE_SIDE, y = row % FINE_SIDE;
  const int variant = copy % THUMBNAIL_VARIANTS;
  const int step = variant % 3;
  const int scale = step == 0 ? 230 : (step == 1 ? 256 : 282);
  const int mirrored = variant >= 3 ? -scale : scale;
  const int u = (2 * x - 31) * mirrored + 31 * 256, v = (2 * y - 31) * scale + 31 * 256;
  const int u0 = u >> 9, v0 = v >> 9, fu = u & 511, fv = v & 511;
  global const char* plane = queries + (copy / THUMBNAIL_VARIANTS * 3 + c) * FINE_SIDE * FINE_SIDE;
  const int sum = (1 << 17) + pixel_or_zero(plane, v0, u0) * (512 - fv) * (512 - fu) +
                  pixel_or_zero(plane, v0, u0 + 1) * (512 - fv) * fu +
                  pixel_or_zero(plane, v0 + 1, u0) * fv * (512 - fu) +
                  pixel_or_zero(plane, v0 + 1, u0 + 1) * fv * fu;
  fine[(copy * 3 + c) * FINE_STRIDE * FINE_STRIDE + (y + FINE_RIM) * FINE_STRIDE + x + FINE_RIM] = (char)(sum >> 18);
}

// Means of 2 x 2 pixels, rounded half up. One work-item: pixel (x, y) of plane c of one variant;
// global = (16, 3 * 16, queries * 6). coarse: [query][variant][3][18][18], the border is not written.
kernel void shrink_queries(global const char* fine, global char* coarse, const int query_count) {
  const int x = get_global_id(0), row = get_global_id(1), copy = get_global_id(2);
  if (x >= COARSE_SIDE || row >= 3 * COARSE_SIDE || copy >= query_count * THUMBNAIL_VARIANTS) return;
  const int c = row / COARSE_SIDE, y = row % COARSE_SIDE;
  global const char* p = fine + (copy * 3 + c) * FINE_STRIDE * FINE_STRIDE + (2 * y + FINE_RIM) * FINE_STRIDE +
                         2 * x + FINE_RIM;
  const int sum = p[0] + p[1] + p[FINE_STRIDE] + p[FINE_STRIDE + 1];
  coarse[(copy * 3 + c) * COARSE_STRIDE * COARSE_STRIDE + (y + COARSE_RIM) * COARSE_STRIDE + x + COARSE_RIM] =
      (char)((sum + 2) >> 2);
}
