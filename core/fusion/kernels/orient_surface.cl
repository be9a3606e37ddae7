// V_t and N_t from the depths of cast_rays and the planes of fit_planes.
//   V = T_world_camera (z (u - cx) / fx, z (v - cy) / fy, z)
//   N = that of the best plane whose window holds the pixel: of the planes fitted around the pixels (u + i, v + j),
//   i, j in {-R, 0, R}, that with the smallest residual + DEPTH_SHARE times the squared error at the pixel itself; the pixel's own counts
//   only MIDDLE_SHARE of that.
// At an edge this takes the plane of one side, so that normals stay sharp (Kuwahara's rule). The normal of
// q = a du + b dv + c is (a fx, b fy, c - a (u - cx) - b (v - cy)).
//
// One work-item: eight neighbouring pixels of a row, one per vector lane.
// depths, planes: see there. T_window_camera: camera metres to voxels of the window, of which origin_m is the first corner in
// the world. vertices, normals: width * height, world, w = 1, or all 0.
#define DEPTH_SHARE 0.5f
#define MIDDLE_SHARE 0.4f

kernel void orient_surface(global const float* depths, global const float* planes, const int width, const int height,
                           const float4 K, const float16 T_window_camera, const float voxel_size_m,
                           const float4 origin_m, global float4* vertices, global float4* normals) {
  const int column = (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  const int columns = (width + 7) / 8;
  if (column >= columns || v >= height) return;
  const int stride = 8 * columns + 2 * PAD;
  const int start = 8 * column + PAD;
  const float8 z = vload8(0, depths + (v + PAD) * stride + start);
  const int8 met = z > 0.0f;
  const float8 q = 1.0f / (met ? z : 1.0f);

  float8 best = 1e20f;
  float8 a = 0.0f, b = 0.0f, c = 0.0f; /* of the best plane, c at this pixel */
  for (int j = -R; j <= R; j += R) {
    for (int i = -R; i <= R; i += R) {
      global const float* plane = planes + 4 * (v + j + PAD) * stride + start + i;
      const float8 plane_a = vload8(0, plane);
      const float8 plane_b = vload8(0, plane + stride);
      const float8 plane_c = vload8(0, plane + 2 * stride) - plane_a * (float)i - plane_b * (float)j;
      const float8 miss = (plane_c - q) * z;
      float8 cost = vload8(0, plane + 3 * stride) + DEPTH_SHARE * miss * miss;
      cost = (i == 0 && j == 0) ? cost * MIDDLE_SHARE : cost;
      const int8 better = cost < best;
      best = better ? cost : best;
      a = better ? plane_a : a;
      b = better ? plane_b : b;
      c = better ? plane_c : c;
    }
  }

  const float16 T = T_window_camera;
  const float8 du = (float)(8 * column) + (float8)(0, 1, 2, 3, 4, 5, 6, 7) - K.z;
  const float dv = (float)v - K.w;
  const float8 cx = du * z / K.x;
  const float8 cy = dv * z / K.y;
  const float8 x = T.s0 * cx + T.s1 * cy + T.s2 * z + T.s3;
  const float8 y = T.s4 * cx + T.s5 * cy + T.s6 * z + T.s7;
  const float8 w = T.s8 * cx + T.s9 * cy + T.sa * z + T.sb;
  const float8 nu = -a * K.x;
  const float8 nv = -b * K.y;
  const float8 nw = a * du + b * dv - c;
  const float8 nx = T.s0 * nu + T.s1 * nv + T.s2 * nw;
  const float8 ny = T.s4 * nu + T.s5 * nv + T.s6 * nw;
  const float8 nz = T.s8 * nu + T.s9 * nv + T.sa * nw;
  const float8 squared = nx * nx + ny * ny + nz * nz;
  const int8 oriented = met & (best < 1e20f) & (squared > 0.0f);
  const float8 scale = oriented ? 1.0f / sqrt(squared) : 0.0f;

  float lanes[8][8];
  vstore8(met ? origin_m.x + voxel_size_m * x : 0.0f, 0, lanes[0]);
  vstore8(met ? origin_m.y + voxel_size_m * y : 0.0f, 0, lanes[1]);
  vstore8(met ? origin_m.z + voxel_size_m * w : 0.0f, 0, lanes[2]);
  vstore8(met ? 1.0f : 0.0f, 0, lanes[3]);
  vstore8(oriented ? nx * scale : 0.0f, 0, lanes[4]);
  vstore8(oriented ? ny * scale : 0.0f, 0, lanes[5]);
  vstore8(oriented ? nz * scale : 0.0f, 0, lanes[6]);
  vstore8(oriented ? 1.0f : 0.0f, 0, lanes[7]);
  const int count = min(8, width - 8 * column);
  for (int i = 0; i < count; ++i) {
    vertices[v * width + 8 * column + i] = (float4)(lanes[0][i], lanes[1][i], lanes[2][i], lanes[3][i]);
    normals[v * width + 8 * column + i] = (float4)(lanes[4][i], lanes[5][i], lanes[6][i], lanes[7][i]);
  }
}
