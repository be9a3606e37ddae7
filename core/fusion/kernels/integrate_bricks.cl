#include "core/fusion/kernels/brick_layout.h"

// Averages a depth image into the signed distance of bricks (Curless and Levoy 1996):
//   sdf = D(pi(p)) - z(p),   d = min(sdf / truncation, 1)   for voxels with sdf > -truncation,
//   d' = (d W + d w) / (W + w),   W' = min(W + w, W_max),   w = 1 observation.
// D is read at the nearest pixel; z is along the optical axis, as depth cameras measure it.
//
// One work-item: one row of 8 voxels along x as a float8 (PoCL does not vectorise this over work-items by itself).
// bricks: brick_count of (x, y, z, slot), counted from the window's first brick; 64 work-items each;
// those not selected (select_bricks) are left as they are.
// T_camera_window: voxels from the window's first to camera metres. depth_m: width * height metres; only readings in
// (0, max_depth_m] count. voxels: BRICK_VOXELS a slot, TsdfVoxel as one uint (distance low, weight high).
#define WEIGHT_ONE 256.0f

kernel void integrate_bricks(global const int4* restrict bricks, const int brick_count,
                             global const uchar* restrict selected, const float16 T_camera_window, const float4 K,
                             const int width, const int height, global const float* restrict depth_m,
                             const float max_depth_m, const float truncation_m, const float max_weight,
                             global uint8* restrict voxels) {
  const int row = (int)get_global_id(0) & 63;
  const int number = (int)get_global_id(0) >> 6;
  if (number >= brick_count || !selected[number]) return;
  const int4 brick = bricks[number];
  const float x = (float)(BRICK_SIDE * brick.x) + 0.5f;
  const float y = (float)(BRICK_SIDE * brick.y + (row & 7)) + 0.5f;
  const float z = (float)(BRICK_SIDE * brick.z + (row >> 3)) + 0.5f;
  const float8 step = (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f);
  const float16 T = T_camera_window;
  const float8 camera_x = step * T.s0 + (T.s0 * x + T.s1 * y + T.s2 * z + T.s3);
  const float8 camera_y = step * T.s4 + (T.s4 * x + T.s5 * y + T.s6 * z + T.s7);
  const float8 camera_z = step * T.s8 + (T.s8 * x + T.s9 * y + T.sa * z + T.sb);

  const float8 inverse_z = 1.0f / camera_z;
  const float8 u = camera_x * inverse_z * K.x + (K.z + 0.5f);
  const float8 v = camera_y * inverse_z * K.y + (K.w + 0.5f);
  const int8 inside = (camera_z > 0.0f) & (u >= 0.0f) & (u < (float)width) & (v >= 0.0f) & (v < (float)height);
  const int8 pixel = inside ? convert_int8(v) * width + convert_int8(u) : 0;
  const float8 depth =
      (float8)(depth_m[pixel.s0], depth_m[pixel.s1], depth_m[pixel.s2], depth_m[pixel.s3], depth_m[pixel.s4],
               depth_m[pixel.s5], depth_m[pixel.s6], depth_m[pixel.s7]);
  const float8 distance = (depth - camera_z) * (1.0f / truncation_m);
  const int8 update = inside & (depth > 0.0f) & (depth <= max_depth_m) & (distance > -1.0f);
  if (!any(update)) return;

  const int index = brick.w * (BRICK_VOXELS / 8) + row;
  const int8 old = as_int8(voxels[index]);
  const float8 old_distance = convert_float8((old << 16) >> 16);
  const float8 old_weight = convert_float8((old >> 16) & 0xffff);
  const float8 seen = update ? (distance < 1.0f ? distance : 1.0f) * 32767.0f : 0.0f;
  const float8 sum = old_weight + WEIGHT_ONE;
  const float8 mean = (old_distance * old_weight + seen * WEIGHT_ONE) / sum;
  // Rounds half up: mean is in [-32767, 32767].
  const int8 rounded = convert_int8(mean + 32768.5f) - 32768;
  const float8 weight = sum < max_weight ? sum : max_weight;
  const int8 fresh = (rounded & 0xffff) | (convert_int8(weight) << 16);
  voxels[index] = as_uint8(update ? fresh : old);
}
