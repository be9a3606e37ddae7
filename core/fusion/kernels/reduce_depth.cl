// Edge-aware reduction: a pixel of the small image covers a square of `ratio` pixels of the large one. Of the readings in it only
// those of the nearest surface count, z_i - z_min < DEPTH_JUMP(z_min), each with the area of its pixel that the square covers:
//   z = sum a_i z_i / sum a_i;  no reading, no depth.
// One work-item: one small pixel. BLOCK (build option) = pixels that a square can touch along an axis.
// large: image, row by row; small: depth plane.
#include "core/fusion/kernels/depth_plane.clh"

kernel void reduce_depth(global const float* restrict large, const int large_width, const int large_height,
                         const float ratio_x, const float ratio_y, const int small_width, const int small_height,
                         const int small_stride, global float* restrict small) {
  const int u = (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  if (u >= small_width || v >= small_height) return;
  // The square spans [left, left + ratio] in units where pixel i of the large image spans [i, i + 1].
  const float left = (float)u * ratio_x;
  const float top = (float)v * ratio_y;
  const int u0 = (int)left;
  const int v0 = (int)top;

  float z[BLOCK * BLOCK];
  float nearest = FLT_MAX;
  for (int dv = 0; dv < BLOCK; ++dv) {
    const int row = min(v0 + dv, large_height - 1);
    for (int du = 0; du < BLOCK; ++du) {
      const int column = min(u0 + du, large_width - 1);
      const float depth = large[row * large_width + column];
      z[dv * BLOCK + du] = depth;
      nearest = (depth > 0.0f) ? fmin(nearest, depth) : nearest;
    }
  }
  const float limit = nearest + DEPTH_JUMP(nearest);
  float sum = 0.0f;
  float area_sum = 0.0f;
  for (int dv = 0; dv < BLOCK; ++dv) {
    const float y = (float)(v0 + dv);
    const float height = fmax(0.0f, fmin(y + 1.0f, top + ratio_y) - fmax(y, top));
    for (int du = 0; du < BLOCK; ++du) {
      const float x = (float)(u0 + du);
      const float width = fmax(0.0f, fmin(x + 1.0f, left + ratio_x) - fmax(x, left));
      const float depth = z[dv * BLOCK + du];
      const float area = (depth > 0.0f && depth < limit) ? width * height : 0.0f;
      sum += area * (depth - nearest);
      area_sum += area;
    }
  }
  small[plane_index(small_stride, u, v)] = (area_sum > 0.0f) ? nearest + sum / area_sum : 0.0f;
}
