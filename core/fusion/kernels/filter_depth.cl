// Edge-preserving filter over 5 x 5 pixels, from pairs of opposite neighbours q and -q:
//   z'(u) = z(u) + sum g(q) k_q (d_q + d_-q) / (1 + 2 sum g(q) k_q),  d_q = z(u + q) - z(u),
//   g(q) = exp(-|q|^2 / (2 * 1.5^2)),  k_q = (k(d_q) k(d_-q))^2,  k(d) = max(0, 1 - (d / s)^2),
//   s = range_base + range_z2 * z(u)^2.
// A bilateral filter with polynomial weights. Pairs preserve slopes at edges and borders, which single neighbours would shift
// inwards. A pixel without reading stays 0, and a neighbour without reading lies beyond s of
// every reading.
// One work-item: LANES pixels of a row. input, output: depth planes of one size.
#include "core/compute/kernels/lanes.clh"
#include "core/fusion/kernels/depth_plane.clh"

#define PAIR(du, dv, g)                                                            \
  {                                                                                \
    const floatN after = LOAD(centre + (dv) * stride + (du)) - z;                  \
    const floatN before = LOAD(centre - (dv) * stride - (du)) - z;                 \
    floatN k = fmax(1.0f - after * after * inverse_s2, 0.0f) *                     \
               fmax(1.0f - before * before * inverse_s2, 0.0f);                    \
    k = k * k * (g);                                                               \
    sum = fma(k, after + before, sum);                                             \
    weight += k;                                                                   \
  }

kernel void filter_depth(global const float* restrict input, const int width, const int height, const int stride,
                         const float range_base, const float range_z2, global float* restrict output) {
  const int u = LANES * (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  if (u >= width || v >= height) return;
  const int index = plane_index(stride, u, v);
  global const float* centre = input + index;
  const floatN z = LOAD(centre);
  const floatN s = range_base + range_z2 * z * z;
  const floatN inverse_s2 = 1.0f / (s * s);
  floatN sum = 0.0f;
  floatN weight = 0.0f;
  PAIR(1, 0, 0.80073740f)
  PAIR(2, 0, 0.41111229f)
  PAIR(-2, 1, 0.32919299f)
  PAIR(-1, 1, 0.64118039f)
  PAIR(0, 1, 0.80073740f)
  PAIR(1, 1, 0.64118039f)
  PAIR(2, 1, 0.32919299f)
  PAIR(-2, 2, 0.16901332f)
  PAIR(-1, 2, 0.32919299f)
  PAIR(0, 2, 0.41111229f)
  PAIR(1, 2, 0.32919299f)
  PAIR(2, 2, 0.16901332f)
  STORE(z + sum / (1.0f + 2.0f * weight), output + index);
}
