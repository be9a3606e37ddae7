// The plane around every pixel that sees a surface. In inverse depth q = 1/z, in which a depth camera's noise is even, a plane
// is linear: q = a du + b dv + c with (du, dv) the pixels' offsets from the middle one. Least squares over the (2 R + 1)^2
// pixels whose depth differs from the middle's by at most SLOPE pixel sizes (z / f) for each pixel of distance.
//
// One work-item: eight neighbouring pixels of a row, one per vector lane.
// depths: see cast_rays. planes: for each of the same rows four rows of the same length, that of a, of b, of c and of the
// residual, the mean square error of q relative to the middle's q^2; NO_PLANE there where there is none. R, SLOPE, PAD are
// build options.
#define NO_PLANE 1e30f

kernel void fit_planes(global const float* depths, const int width, const int height, const float focal,
                       global float* planes) {
  const int column = (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  const int columns = (width + 7) / 8;
  if (column >= columns || v >= height) return;
  const int stride = 8 * columns + 2 * PAD;
  const int start = 8 * column + PAD;
  global const float* middle = depths + (v + PAD) * stride + start;
  const float8 z = vload8(0, middle);
  const int8 met = z > 0.0f;
  const float8 q0 = 1.0f / (met ? z : 1.0f);
  const float8 per_pixel = z * (SLOPE / focal);

  float8 n = 0.0f, su = 0.0f, sv = 0.0f, suu = 0.0f, suv = 0.0f, svv = 0.0f;
  float8 sq = 0.0f, suq = 0.0f, svq = 0.0f, sqq = 0.0f;
  for (int j = -R; j <= R; ++j) {
    for (int i = -R; i <= R; ++i) {
      const float8 zi = vload8(0, middle + j * stride + i);
      const int8 take = (zi > 0.0f) & (fabs(zi - z) <= per_pixel * (float)max(abs(i), abs(j)));
      const float8 one = take ? 1.0f : 0.0f;
      const float8 q = take ? 1.0f / zi - q0 : 0.0f;
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
  const float8 inverse_n = 1.0f / n;
  const float8 cuu = suu - su * su * inverse_n;
  const float8 cuv = suv - su * sv * inverse_n;
  const float8 cvv = svv - sv * sv * inverse_n;
  const float8 cuq = suq - su * sq * inverse_n;
  const float8 cvq = svq - sv * sq * inverse_n;
  const float8 cqq = sqq - sq * sq * inverse_n;
  const float8 determinant = cuu * cvv - cuv * cuv;
  const float8 a = (cvv * cuq - cuv * cvq) / determinant;
  const float8 b = (cuu * cvq - cuv * cuq) / determinant;
  const float8 c = q0 + (sq - a * su - b * sv) * inverse_n;
  const float8 error = (cqq - a * cuq - b * cvq) * inverse_n * z * z;
  const int8 fits = met & (n >= 5.0f) & (determinant > 1.0f);

  global float* out = planes + 4 * (v + PAD) * stride + start;
  vstore8(fits ? a : 0.0f, 0, out);
  vstore8(fits ? b : 0.0f, 0, out + stride);
  vstore8(fits ? c : 0.0f, 0, out + 2 * stride);
  vstore8(fits ? (error > 0.0f ? error : 0.0f) : NO_PLANE, 0, out + 3 * stride);
}
