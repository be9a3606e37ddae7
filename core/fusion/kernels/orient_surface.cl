// V_t and N_t from the inverse depths of cast_rays and the planes of fit_planes.
//   V = T_world_camera (z (u - cx) / fx, z (v - cy) / fy, z)
//   N = normal of the best plane whose window contains the pixel. Of the planes around the pixels (u + i, v + j),
//   i, j in {-FIT_RADIUS, 0, FIT_RADIUS}, it has the smallest cost: residual + DEPTH_SHARE times the squared error at this
//   pixel. The cost of the pixel's own plane is multiplied by MIDDLE_SHARE.
// At an edge this takes the plane of one side, so that normals stay sharp (Kuwahara's rule). The normal of
// q = a du + b dv + c is (a fx, b fy, c - a (u - cx) - b (v - cy)).
//
// One work-item: LANES neighbouring pixels of a row.
// inverse_depths, planes: see cast_rays and fit_planes. T_window_camera: camera metres to voxels of the window; origin_m: its
// first corner in the world. vertices, normals: width * height, world, w = 1, or all 0.
#include "core/compute/kernels/lanes.clh"
#include "core/fusion/kernels/ray_layout.h"

#define DEPTH_SHARE 0.5f
#define MIDDLE_SHARE 0.4f

kernel void orient_surface(global const float* inverse_depths, global const float* planes, const int width, const int height,
                           const float4 K, const float16 T_window_camera, const float voxel_size_m,
                           const float4 origin_m, global float4* vertices, global float4* normals) {
  const int u = LANES * (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  if (u >= width || v >= height) return;
  const int stride = RAY_STRIDE(width);
  const int start = u + RAY_PAD;
  const floatN q = LOAD(inverse_depths + (v + RAY_PAD) * stride + start);
  const intN met = q > 0.0f;
  const floatN z = 1.0f / (met ? q : 1.0f);

  floatN best = 1e20f;
  floatN a = 0.0f, b = 0.0f, c = 0.0f; /* of the best plane, c at this pixel */
  for (int j = -FIT_RADIUS; j <= FIT_RADIUS; j += FIT_RADIUS) {
    for (int i = -FIT_RADIUS; i <= FIT_RADIUS; i += FIT_RADIUS) {
      global const float* plane = planes + 4 * (v + j + RAY_PAD) * stride + start + i;
      const floatN plane_a = LOAD(plane);
      const floatN plane_b = LOAD(plane + stride);
      const floatN plane_c = LOAD(plane + 2 * stride) - plane_a * (float)i - plane_b * (float)j;
      const floatN miss = (plane_c - q) * z;
      floatN cost = LOAD(plane + 3 * stride) + DEPTH_SHARE * miss * miss;
      cost = (i == 0 && j == 0) ? cost * MIDDLE_SHARE : cost;
      const intN better = cost < best;
      best = better ? cost : best;
      a = better ? plane_a : a;
      b = better ? plane_b : b;
      c = better ? plane_c : c;
    }
  }

  const float16 T = T_window_camera;
  const floatN du = (float)u + convert_floatN(LANE) - K.z;
  const float dv = (float)v - K.w;
  const floatN cx = du * z / K.x;
  const floatN cy = dv * z / K.y;
  const floatN x = T.s0 * cx + T.s1 * cy + T.s2 * z + T.s3;
  const floatN y = T.s4 * cx + T.s5 * cy + T.s6 * z + T.s7;
  const floatN w = T.s8 * cx + T.s9 * cy + T.sa * z + T.sb;
  const floatN nu = -a * K.x;
  const floatN nv = -b * K.y;
  const floatN nw = a * du + b * dv - c;
  const floatN nx = T.s0 * nu + T.s1 * nv + T.s2 * nw;
  const floatN ny = T.s4 * nu + T.s5 * nv + T.s6 * nw;
  const floatN nz = T.s8 * nu + T.s9 * nv + T.sa * nw;
  const floatN squared = nx * nx + ny * ny + nz * nz;
  const intN oriented = met & where(best < 1e20f) & where(squared > 0.0f);
  const floatN scale = oriented ? 1.0f / sqrt(squared) : 0.0f;

  const int out = v * width + u;
  const Points vertex = {met ? origin_m.x + voxel_size_m * x : 0.0f, met ? origin_m.y + voxel_size_m * y : 0.0f,
                         met ? origin_m.z + voxel_size_m * w : 0.0f, one_where(met)};
  const Points normal = {oriented ? nx * scale : 0.0f, oriented ? ny * scale : 0.0f, oriented ? nz * scale : 0.0f,
                         one_where(oriented)};
  store_points(vertex, vertices + out, width - u);
  store_points(normal, normals + out, width - u);
}
