// The plane around every pixel with surface. In inverse depth q = 1/z, a depth camera's noise is uniform and a plane is
// linear: q = a du + b dv + c with (du, dv) the pixels' offsets from the middle one. Least squares over the
// (2 FIT_RADIUS + 1)^2 pixels whose depth differs from the middle's by at most FIT_SLOPE pixel sizes (z / fx for columns, z / fy
// for rows) for each pixel of distance, by the larger of the two.
//
// One work-item: LANES neighbouring pixels of a row.
// inverse_depths: see cast_rays. planes: four rows of the same length per row: a, b, c and the residual, which is the mean square
// error of q relative to the middle's q^2, or NO_PLANE.
#include "core/compute/kernels/lanes.clh"
#include "core/fusion/kernels/ray_layout.h"

#if FIT_RADIUS != 3
#error "The sums of other windows need other bits."
#endif

kernel void fit_planes(global const float* inverse_depths, const int width, const int height, const float2 focal,
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
  // Bounds of the inverse depths that belong to the plane, by distance in rows and columns (see above).
  floatN lowest[FIT_RADIUS + 1][FIT_RADIUS + 1], highest[FIT_RADIUS + 1][FIT_RADIUS + 1];
#pragma unroll
  for (int rows = 0; rows <= FIT_RADIUS; ++rows) {
#pragma unroll
    for (int columns = 0; columns <= FIT_RADIUS; ++columns) {
      const float slope = max(FIT_SLOPE / focal.x * (float)columns, FIT_SLOPE / focal.y * (float)rows);
      lowest[rows][columns] = q0 * (1.0f / (1.0f + slope));
      highest[rows][columns] = slope < 1.0f ? q0 * (1.0f / (1.0f - slope)) : FLT_MAX;
    }
  }

  // Sums over the pixels of the plane. i and j count from the corner, so that none is negative and several share a word.
  intN counts = 0;  /* 1, i, j; i^2 from the middle */
  intN moments = 0; /* j^2 from the middle; i j */
  floatN sq = 0.0f, suq = 0.0f, svq = 0.0f, sqq = 0.0f;
#pragma unroll
  for (int j = -FIT_RADIUS; j <= FIT_RADIUS; ++j) {
    floatN row = 0.0f;
#pragma unroll
    for (int i = -FIT_RADIUS; i <= FIT_RADIUS; ++i) {
      const int right = i + FIT_RADIUS, down = j + FIT_RADIUS;
      const floatN qi = LOAD(middle + j * stride + i);
      const intN take = where(qi >= lowest[abs(j)][abs(i)]) & where(qi <= highest[abs(j)][abs(i)]);
      const floatN q = take ? qi - q0 : 0.0f;
      counts += take ? (intN)(1 | right << 6 | down << 14 | i * i << 22) : (intN)(0);
      moments += take ? (intN)(j * j | right * down << 8) : (intN)(0);
      row += q;
      suq += q * (float)i;
      sqq += q * q;
    }
    sq += row;
    svq += row * (float)j;
  }
  const float radius = (float)FIT_RADIUS;
  const floatN n = convert_floatN(counts & 63);
  const floatN su = convert_floatN((counts >> 6) & 255) - radius * n;
  const floatN sv = convert_floatN((counts >> 14) & 255) - radius * n;
  const floatN suu = convert_floatN(counts >> 22);
  const floatN svv = convert_floatN(moments & 255);
  const floatN suv = convert_floatN(moments >> 8) - radius * (su + sv + radius * n);
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
  const intN fits = met & where(n >= 5.0f) & where(determinant > 1.0f);

  global float* out = planes + 4 * (v + RAY_PAD) * stride + start;
  STORE(fits ? a : 0.0f, out);
  STORE(fits ? b : 0.0f, out + stride);
  STORE(fits ? c : 0.0f, out + 2 * stride);
  STORE(fits ? (error > 0.0f ? error : 0.0f) : NO_PLANE, out + 3 * stride);
}
