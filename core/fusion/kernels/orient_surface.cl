// V_t and N_t from the depths of cast_rays.
//   V = T_world_camera (z (u - cx) / fx, z (v - cy) / fy, z)
// N is that of the plane that fits the depths around best. In inverse depth q = 1/z (in which a depth camera's noise is even) a
// plane is linear: q = a du + b dv + c, its normal ~ (a fx, b fy, c - a (u - cx) - b (v - cy)). Least squares over the
// (2 R + 1)^2 pixels whose depth differs from the middle's by at most SLOPE pixel sizes for each pixel of distance.
//
// One work-item: eight neighbouring pixels of a row, one per vector lane.
// depths: rows of `stride` floats padded on all sides by PAD zeros; see cast_rays. vertices, normals: width * height,
// world, w = 1, or all 0.
kernel void orient_surface(global const float* depths, const int width, const int height, const float4 K,
                           const float16 T_window_camera, const float voxel_size_m, const float4 origin_m,
                           global float4* vertices, global float4* normals) {
  const int column = (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  const int columns = (width + 7) / 8;
  if (column >= columns || v >= height) return;
  const int stride = 8 * columns + 2 * PAD;
  global const float* here = depths + (v + PAD) * stride + 8 * column + PAD;
  const float8 z = vload8(0, here);
  const int8 met = z > 0.0f;
  const float8 du = (float)(8 * column) + (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f) - K.z;
  const float dv = (float)v - K.w;
  const float16 T = T_window_camera;
  const float8 cx = du / K.x;
  const float cy = dv / K.y;
  const float8 x = T.s3 + z * (T.s0 * cx + (T.s1 * cy + T.s2));
  const float8 y = T.s7 + z * (T.s4 * cx + (T.s5 * cy + T.s6));
  const float8 w = T.sb + z * (T.s8 * cx + (T.s9 * cy + T.sa));
  float8 nx, ny, nz;
  int8 ok = met;
  const float8 q0 = 1.0f / z;
  const float8 per_pixel = z * (SLOPE / K.x);
  float8 n = 0.0f, su = 0.0f, sv = 0.0f, suu = 0.0f, suv = 0.0f, svv = 0.0f, sq = 0.0f, suq = 0.0f, svq = 0.0f;
  for (int j = -R; j <= R; ++j) {
    for (int i = -R; i <= R; ++i) {
      const float8 zi = vload8(0, here + j * stride + i);
      const float8 gate = per_pixel * (float)max(abs(i), abs(j));
      const int8 take = (zi > 0.0f) & (fabs(zi - z) <= gate);
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
    }
  }
  const float8 inverse_n = 1.0f / n;
  const float8 cuu = suu - su * su * inverse_n;
  const float8 cuv = suv - su * sv * inverse_n;
  const float8 cvv = svv - sv * sv * inverse_n;
  const float8 cuq = suq - su * sq * inverse_n;
  const float8 cvq = svq - sv * sq * inverse_n;
  const float8 det = cuu * cvv - cuv * cuv;
  const float8 pa = (cvv * cuq - cuv * cvq) / det;
  const float8 pb = (cuu * cvq - cuv * cuq) / det;
  const float8 pc = q0 + (sq - pa * su - pb * sv) * inverse_n;
  ok &= (n >= 5.0f) & (det > 1.0f);
  const float8 fx = -pa * K.x;
  const float8 fy = -pb * K.y;
  const float8 fz = -(pc - pa * du - pb * dv);
  nx = T.s0 * fx + T.s1 * fy + T.s2 * fz;
  ny = T.s4 * fx + T.s5 * fy + T.s6 * fz;
  nz = T.s8 * fx + T.s9 * fy + T.sa * fz;
  const float8 side = -1.0f;
  const float8 squared = nx * nx + ny * ny + nz * nz;
  ok &= squared > 0.0f;
  const float8 scale = ok ? (side > 0.0f ? -1.0f : 1.0f) / sqrt(squared) : 0.0f;
  float lanes[7][8];
  vstore8(met ? origin_m.x + voxel_size_m * x : 0.0f, 0, lanes[0]);
  vstore8(met ? origin_m.y + voxel_size_m * y : 0.0f, 0, lanes[1]);
  vstore8(met ? origin_m.z + voxel_size_m * w : 0.0f, 0, lanes[2]);
  vstore8(ok ? nx * scale : 0.0f, 0, lanes[3]);
  vstore8(ok ? ny * scale : 0.0f, 0, lanes[4]);
  vstore8(ok ? nz * scale : 0.0f, 0, lanes[5]);
  vstore8(ok ? 1.0f : 0.0f, 0, lanes[6]);
  const int count = min(8, width - 8 * column);
  for (int i = 0; i < count; ++i) {
    vertices[v * width + 8 * column + i] = (float4)(lanes[0][i], lanes[1][i], lanes[2][i], here[i] > 0.0f ? 1.0f : 0.0f);
    normals[v * width + 8 * column + i] = (float4)(lanes[3][i], lanes[4][i], lanes[5][i], lanes[6][i]);
  }
}
