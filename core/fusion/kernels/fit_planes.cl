// The plane around every pixel that sees a surface. In inverse depth q = 1/z, in which a depth camera's noise is even, a plane
// is linear: q = a du + b dv + c with (du, dv) the pixels' offsets from the middle one. Least squares over the
// (2 FIT_RADIUS + 1)^2 pixels whose depth differs from the middle's by at most FIT_SLOPE pixel sizes (z / f) for each pixel of
// distance.
//
// One work-item: LANES neighbouring pixels of a row.
// inverse_depths: see cast_rays. planes: for each of the same rows four rows of the same length, that of a, of b, of c and of the
// residual, the mean square error of q relative to the middle's q^2; NO_PLANE there where there is none.
#include "core/compute/kernels/lanes.clh"
#include "core/fusion/kernels/ray_layout.h"

kernel void fit_planes(global const float* inverse_depths, const int width, const int height, const float focal,
                       global float* planes) {
  const int u = LANES * (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  if (u >= width || v >= height) return;
  const int stride = RAY_STRIDE(width);
  const int start = u + RAY_PAD;
  global const float* middle = inverse_depths + (v + RAY_PAD) * stride + start;
  const floatN q0 = LOAD(middle);
  const intN met = q0 > 0.0f;
  const floatN z = 1.0f / (met ? q0 : 1.0f);
  const float per_pixel = FIT_SLOPE / focal;

  floatN n = 0.0f, su = 0.0f, sv = 0.0f, suu = 0.0f, suv = 0.0f, svv = 0.0f;
  floatN sq = 0.0f, suq = 0.0f, svq = 0.0f, sqq = 0.0f;
#pragma unroll
  for (int j = -FIT_RADIUS; j <= FIT_RADIUS; ++j) {
#pragma unroll
    for (int i = -FIT_RADIUS; i <= FIT_RADIUS; ++i) {
      const floatN qi = LOAD(middle + j * stride + i);
      const floatN nearer = z * qi; /* z / zi, for |zi - z| <= per_pixel z max(|i|, |j|) without a division */
      const intN belongs = fabs(1.0f - nearer) <= per_pixel * (float)max(abs(i), abs(j)) * nearer;
      const int is_middle = i == 0 && j == 0 ? -1 : 0; /* where `nearer` may be rounded to something beside 1 */
      const intN take = (qi > 0.0f) & (belongs | is_middle);
      const floatN one = take ? 1.0f : 0.0f;
      const floatN q = take ? qi - q0 : 0.0f;
      n += one;
      su += one * (float)i;
      sv += one * (float)j;
      suu += one * (float)(i * i);
      suv += one * (float)(i * j);
      svv += one * (float)(j * j);
      sq += q;
      suq += q * (float)i;
      svq += q * (float)j;
      sqq += q * q;
    }
  }
  const floatN inverse_n = 1.0f / n;
  const floatN cuu = suu - su * su * inverse_n;
  const floatN cuv = suv - su * sv * inverse_n;
  const floatN cvv = svv - sv * sv * inverse_n;
  const floatN cuq = suq - su * sq * inverse_n;
  const floatN cvq = svq - sv * sq * inverse_n;
  const floatN cqq = sqq - sq * sq * inverse_n;
  const floatN determinant = cuu * cvv - cuv * cuv;
  const floatN a = (cvv * cuq - cuv * cvq) / determinant;
  const floatN b = (cuu * cvq - cuv * cuq) / determinant;
  const floatN c = q0 + (sq - a * su - b * sv) * inverse_n;
  const floatN error = (cqq - a * cuq - b * cvq) * inverse_n * z * z;
  const intN fits = met & (n >= 5.0f) & (determinant > 1.0f);

  global float* out = planes + 4 * (v + RAY_PAD) * stride + start;
  STORE(fits ? a : 0.0f, out);
  STORE(fits ? b : 0.0f, out + stride);
  STORE(fits ? c : 0.0f, out + 2 * stride);
  STORE(fits ? (error > 0.0f ? error : 0.0f) : NO_PLANE, out + 3 * stride);
}
