// Edge-aware reduction of 2 x 2 pixels to one: the mean of those readings of the square that belong to its nearest surface,
// z_i - z_min < DEPTH_JUMP(z_min); no reading, no depth. The same rule as reduce_depth at ratio 2, as vectors.
// One work-item: 8 small pixels of a row.
// large: plane with large_pad zeros around (0: plain image), large_stride a row; small: depth plane. An odd last
// column or row of `large` is left out.
#include "core/fusion/kernels/depth_plane.clh"

inline float8 mean_of_nearest(const float8 a, const float8 b, const float8 c, const float8 d) {
  const float8 far = 1e9f;
  const float8 far_a = select(far, a, a > 0.0f);
  const float8 far_b = select(far, b, b > 0.0f);
  const float8 far_c = select(far, c, c > 0.0f);
  const float8 far_d = select(far, d, d > 0.0f);
  const float8 nearest = fmin(fmin(far_a, far_b), fmin(far_c, far_d));
  const float8 jump = DEPTH_JUMP(nearest);
  const float8 zero = 0.0f;
  const float8 one = 1.0f;
  const float8 e_a = far_a - nearest, e_b = far_b - nearest, e_c = far_c - nearest, e_d = far_d - nearest;
  // Where there is no reading at all, `nearest` is the far value and the result is dropped below.
  const float8 sum = select(zero, e_a, e_a < jump) + select(zero, e_b, e_b < jump) + select(zero, e_c, e_c < jump) +
                     select(zero, e_d, e_d < jump);
  const float8 count = select(zero, one, e_a < jump) + select(zero, one, e_b < jump) + select(zero, one, e_c < jump) +
                       select(zero, one, e_d < jump);
  return select(nearest + sum / count, zero, nearest >= far);
}

kernel void halve_depth(global const float* restrict large, const int large_stride, const int large_pad,
                        const int small_width, const int small_height, const int small_stride,
                        global float* restrict small) {
  const int u = (int)get_global_id(0) * 8;
  const int v = (int)get_global_id(1);
  if (u >= small_width || v >= small_height) return;
  global const float* upper = large + (2 * v + large_pad) * large_stride + 2 * u + large_pad;
  global const float* lower = upper + large_stride;
  global float* out = small + plane_index(small_stride, u, v);
  if (u + 8 <= small_width) {
    const float16 above = vload16(0, upper);
    const float16 below = vload16(0, lower);
    vstore8(mean_of_nearest(above.even, above.odd, below.even, below.odd), 0, out);
  } else {
    for (int i = 0; i < small_width - u; ++i) {
      out[i] = mean_of_nearest((float8)(upper[2 * i]), (float8)(upper[2 * i + 1]), (float8)(lower[2 * i]),
                               (float8)(lower[2 * i + 1])).s0;
    }
  }
}
