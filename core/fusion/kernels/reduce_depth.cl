// Edge-aware reduction: a pixel of the small image covers a rectangle of the large one. Only readings of the nearest surface in it
// count, z_i - z_min < DEPTH_JUMP(z_min), each with the covered area of its pixel:
//   z = sum a_i z_i / sum a_i;  0 without readings.
// Lengths along an axis are integers: a large pixel is small_width (small_height) long, a rectangle large_width
// (large_height). So no rounding decides which pixels a rectangle covers, and mirrored images give mirrored results.
// One work-item: one small pixel. large: image, row by row; small: depth plane.
#include "core/fusion/kernels/depth_plane.clh"

inline float covered_length(const int pixel, const int pixel_length, const int first, const int last) {
  return (float)(min((pixel + 1) * pixel_length, last) - max(pixel * pixel_length, first)) / (float)pixel_length;
}

kernel void reduce_depth(global const float* restrict large, const int large_width, const int large_height,
                         const int small_width, const int small_height, const int small_stride,
                         global float* restrict small) {
  const int u = (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  if (u >= small_width || v >= small_height) return;
  const int left = u * large_width;
  const int right = left + large_width;
  const int top = v * large_height;
  const int bottom = top + large_height;
  const int first_column = left / small_width;
  const int last_column = (right - 1) / small_width;
  const int first_row = top / small_height;
  const int last_row = (bottom - 1) / small_height;

  float nearest = FLT_MAX;
  for (int row = first_row; row <= last_row; ++row) {
    for (int column = first_column; column <= last_column; ++column) {
      const float depth = large[row * large_width + column];
      nearest = (depth > 0.0f) ? fmin(nearest, depth) : nearest;
    }
  }
  const float limit = nearest + DEPTH_JUMP(nearest);
  float sum = 0.0f;
  float area_sum = 0.0f;
  for (int row = first_row; row <= last_row; ++row) {
    const float height = covered_length(row, small_height, top, bottom);
    for (int column = first_column; column <= last_column; ++column) {
      const float width = covered_length(column, small_width, left, right);
      const float depth = large[row * large_width + column];
      const float area = (depth > 0.0f && depth < limit) ? width * height : 0.0f;
      sum += area * (depth - nearest);
      area_sum += area;
    }
  }
  small[plane_index(small_stride, u, v)] = (area_sum > 0.0f) ? nearest + sum / area_sum : 0.0f;
}
