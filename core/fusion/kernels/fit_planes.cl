// The plane around every pixel that sees a surface. In inverse depth q = 1/z, in which a depth camera's noise is even, a plane
// is linear: q = a du + b dv + c with (du, dv) the pixels' offsets from the middle one. Least squares over the
// (2 FIT_RADIUS + 1)^2 pixels whose depth differs from the middle's by at most FIT_SLOPE pixel sizes (z / f) for each pixel of
// distance.
//
// One work-item: LANES_X neighbouring pixels of a row.
// depths: see cast_rays. planes: for each of the same rows four rows of the same length, that of a, of b, of c and of the
// residual, the mean square error of q relative to the middle's q^2; NO_PLANE there where there is none.
#include "core/compute/kernels/lanes.clh"
#include "core/fusion/kernels/ray_layout.h"

kernel void fit_planes(global const float* depths, const int width, const int height, const float focal,
                       global float* planes) {
  const int u = LANES_X * (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  if (u >= width || v >= height) return;
  const int stride = RAY_STRIDE(width);
  const int start = u + RAY_PAD;
  global const float* middle = depths + (v + RAY_PAD) * stride + start;
  const floatH z = LOAD_H(middle);
  const intH met = z > 0.0f;
  const floatH q0 = 1.0f / (met ? z : 1.0f);
  const floatH per_pixel = z * (FIT_SLOPE / focal);

  floatH n = 0.0f, su = 0.0f, sv = 0.0f, suu = 0.0f, suv = 0.0f, svv = 0.0f;
  floatH sq = 0.0f, suq = 0.0f, svq = 0.0f, sqq = 0.0f;
  for (int j = -FIT_RADIUS; j <= FIT_RADIUS; ++j) {
    for (int i = -FIT_RADIUS; i <= FIT_RADIUS; ++i) {
      const floatH zi = LOAD_H(middle + j * stride + i);
      const intH take = (zi > 0.0f) & (fabs(zi - z) <= per_pixel * (float)max(abs(i), abs(j)));
      const floatH one = take ? 1.0f : 0.0f;
      const floatH q = take ? 1.0f / zi - q0 : 0.0f;
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
  const floatH inverse_n = 1.0f / n;
  const floatH cuu = suu - su * su * inverse_n;
  const floatH cuv = suv - su * sv * inverse_n;
  const floatH cvv = svv - sv * sv * inverse_n;
  const floatH cuq = suq - su * sq * inverse_n;
  const floatH cvq = svq - sv * sq * inverse_n;
  const floatH cqq = sqq - sq * sq * inverse_n;
  const floatH determinant = cuu * cvv - cuv * cuv;
  const floatH a = (cvv * cuq - cuv * cvq) / determinant;
  const floatH b = (cuu * cvq - cuv * cuq) / determinant;
  const floatH c = q0 + (sq - a * su - b * sv) * inverse_n;
  const floatH error = (cqq - a * cuq - b * cvq) * inverse_n * z * z;
  const intH fits = met & (n >= 5.0f) & (determinant > 1.0f);

  global float* out = planes + 4 * (v + RAY_PAD) * stride + start;
  STORE_H(fits ? a : 0.0f, out);
  STORE_H(fits ? b : 0.0f, out + stride);
  STORE_H(fits ? c : 0.0f, out + 2 * stride);
  STORE_H(fits ? (error > 0.0f ? error : 0.0f) : NO_PLANE, out + 3 * stride);
}
