// Edge-aware reduction of 2 x 2 pixels to one: the mean of the readings that belong to the nearest surface of the square,
// z_i - z_min < DEPTH_JUMP(z_min); 0 without readings. The same rule as reduce_depth at ratio 2, as vectors.
// One work-item: LANES_X small pixels of a row.
// large: image with a border of large_pad zeros (0: none), large_stride per row; small: depth plane. An odd last
// column or row of `large` is ignored.
#include "core/compute/kernels/lanes.clh"
#include "core/fusion/kernels/depth_plane.clh"

// Twice as many large pixels.
#if LANES >= 8
#define floatD float16
#define LOAD_D(from) vload16(0, from)
#elif LANES == 4
#define floatD float8
#define LOAD_D(from) vload8(0, from)
#endif

inline floatH mean_of_nearest(const floatH a, const floatH b, const floatH c, const floatH d) {
  const floatH far = 1e9f;
  const floatH far_a = select(far, a, a > 0.0f);
  const floatH far_b = select(far, b, b > 0.0f);
  const floatH far_c = select(far, c, c > 0.0f);
  const floatH far_d = select(far, d, d > 0.0f);
  const floatH nearest = fmin(fmin(far_a, far_b), fmin(far_c, far_d));
  const floatH jump = DEPTH_JUMP(nearest);
  const floatH zero = 0.0f;
  const floatH one = 1.0f;
  const floatH e_a = far_a - nearest, e_b = far_b - nearest, e_c = far_c - nearest, e_d = far_d - nearest;
  // Without any reading, `nearest` is the far value, and the result below is 0.
  const floatH sum = select(zero, e_a, e_a < jump) + select(zero, e_b, e_b < jump) + select(zero, e_c, e_c < jump) +
                     select(zero, e_d, e_d < jump);
  const floatH count = select(zero, one, e_a < jump) + select(zero, one, e_b < jump) + select(zero, one, e_c < jump) +
                       select(zero, one, e_d < jump);
  return select(nearest + sum / count, zero, nearest >= far);
}

kernel void halve_depth(global const float* restrict large, const int large_stride, const int large_pad,
                        const int small_width, const int small_height, const int small_stride,
                        global float* restrict small) {
  const int u = (int)get_global_id(0) * LANES_X;
  const int v = (int)get_global_id(1);
  if (u >= small_width || v >= small_height) return;
  global const float* upper = large + (2 * v + large_pad) * large_stride + 2 * u + large_pad;
  global const float* lower = upper + large_stride;
  global float* out = small + plane_index(small_stride, u, v);
#if LANES == 1
  *out = mean_of_nearest(upper[0], upper[1], lower[0], lower[1]);
#else
  if (u + LANES_X <= small_width) {
    const floatD above = LOAD_D(upper);
    const floatD below = LOAD_D(lower);
    STORE_H(mean_of_nearest(above.even, above.odd, below.even, below.odd), out);
  } else {
    for (int i = 0; i < small_width - u; ++i) {
      out[i] = mean_of_nearest((floatH)(upper[2 * i]), (floatH)(upper[2 * i + 1]), (floatH)(lower[2 * i]),
                               (floatH)(lower[2 * i + 1])).s0;
    }
  }
#endif
}
