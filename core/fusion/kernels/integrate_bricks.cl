#include "core/fusion/kernels/brick_layout.h"

// Averages a depth image into the signed distance of bricks (Curless and Levoy 1996):
//   sdf = D(pi(p)) - z(p),   d = min(sdf / truncation, 1)   for voxels with sdf > -truncation,
//   d' = (d W + d w) / (W + w),   W' = min(W + w, W_max),   w = 1 observation.
// D is read at the nearest pixel; z is along the optical axis, as depth cameras measure it.
//
// One work-item: one brick, two rows of 8 voxels along x at a time as a float16 (PoCL does not vectorise this over work-items by
// itself). bricks: brick_count of (x, y, z, slot), counted from the window's first brick.
// readings: bounds of the readings that each brick may meet (see find_brick_readings). They tell most rows that lie wholly
// behind (left as they are) or in front (free space, d = 1) of the surface without a look at the image.
// T_camera_window: voxels from the window's first to camera metres. depth_m: width * height metres; only readings in
// (0, max_depth_m] count. voxels: BRICK_VOXELS a slot, TsdfVoxel as one uint (distance low, weight high).
// empty(brick) = 1 if the image shows free space in all of it, so that no reading's band touches it, and its averages say so
// too: no voxel within half a truncation of a surface; else 0.
#define WEIGHT_ONE 256.0f
#define ROUNDING_M 1e-4f
#define HALF_TRUNCATION 16384

// The running average of what two rows of voxels have and what they have `seen` now.
inline uint16 average(const uint16 voxels, const float16 seen, const float max_weight) {
  const int16 old = as_int16(voxels);
  const float16 old_distance = convert_float16((old << 16) >> 16);
  const float16 old_weight = convert_float16((old >> 16) & 0xffff);
  const float16 sum = old_weight + WEIGHT_ONE;
  const float16 mean = (old_distance * old_weight + seen * WEIGHT_ONE) / sum;
  // Rounds half up: mean is in [-32767, 32767].
  const int16 rounded = convert_int16(mean + 32768.5f) - 32768;
  const float16 weight = sum < max_weight ? sum : max_weight;
  return as_uint16((rounded & 0xffff) | (convert_int16(weight) << 16));
}

kernel void integrate_bricks(global const int4* restrict bricks, const int brick_count,
                             global const float2* restrict readings, const float16 T_camera_window, const float4 K,
                             const int width, const int height, global const float* restrict depth_m,
                             const float max_depth_m, const float truncation_m, const float max_weight,
                             global uint16* restrict voxels, global uchar* restrict empty) {
  const int number = (int)get_global_id(0);
  if (number >= brick_count) return;
  empty[number] = 0;
  if (readings[number].y == 0.0f) return;
  const int4 brick = bricks[number];
  const float behind = readings[number].y + truncation_m + ROUNDING_M;
  const float in_front = readings[number].x - truncation_m - ROUNDING_M;
  const float16 T = T_camera_window;
  const float centre_to_corner = 0.5f * (fabs(T.s8) + fabs(T.s9) + fabs(T.sa));
  const float x = (float)(BRICK_SIDE * brick.x) + 0.5f;
  const float y = (float)(BRICK_SIDE * brick.y) + 0.5f;
  const float z = (float)(BRICK_SIDE * brick.z) + 0.5f;
  const float first_x = T.s0 * x + T.s1 * y + T.s2 * z + T.s3;
  const float first_y = T.s4 * x + T.s5 * y + T.s6 * z + T.s7;
  const float first_z = T.s8 * x + T.s9 * y + T.sa * z + T.sb;
  const float16 right = (float16)(0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7);
  const float16 down = (float16)(0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1);
  const float16 rows_x = right * T.s0 + down * T.s1;
  const float16 rows_y = right * T.s4 + down * T.s5;
  const float16 rows_z = right * T.s8 + down * T.s9;
  const float nearest_of_rows = fmin(7.0f * T.s8, 0.0f) + fmin(T.s9, 0.0f);
  const float farthest_of_rows = fmax(7.0f * T.s8, 0.0f) + fmax(T.s9, 0.0f);

  int free_rows = 0;
  for (int rows = 0; rows < BRICK_VOXELS / 16; ++rows) {
    const float row_y = (float)(2 * (rows & 3));
    const float row_z = (float)(rows >> 2);
    const float camera_first_z = first_z + T.s9 * row_y + T.sa * row_z;
    if (camera_first_z + nearest_of_rows > behind) continue;
    const int index = brick.w * (BRICK_VOXELS / 16) + rows;
    if (camera_first_z + farthest_of_rows < in_front) {
      const uint16 fresh = average(voxels[index], 32767.0f, max_weight);
      voxels[index] = fresh;
      const int16 near = (as_int16(fresh) << 16) >> 16 < HALF_TRUNCATION;
      const int8 some = near.lo | near.hi;
      const int4 fewer = some.lo | some.hi;
      const int far_off = camera_first_z + farthest_of_rows + centre_to_corner < in_front;
      if (far_off && (fewer.x | fewer.y | fewer.z | fewer.w) == 0) ++free_rows;
      continue;
    }
    const float16 camera_x = rows_x + (first_x + T.s1 * row_y + T.s2 * row_z);
    const float16 camera_y = rows_y + (first_y + T.s5 * row_y + T.s6 * row_z);
    const float16 camera_z = rows_z + camera_first_z;
    const float16 inverse_z = 1.0f / camera_z;
    const float16 u = camera_x * inverse_z * K.x + (K.z + 0.5f);
    const float16 v = camera_y * inverse_z * K.y + (K.w + 0.5f);
    const int16 inside = (camera_z > 0.0f) & (u >= 0.0f) & (u < (float)width) & (v >= 0.0f) & (v < (float)height);
    const int16 pixel = inside ? convert_int16(v) * width + convert_int16(u) : 0;
    const float16 depth =
        (float16)(depth_m[pixel.s0], depth_m[pixel.s1], depth_m[pixel.s2], depth_m[pixel.s3], depth_m[pixel.s4],
                  depth_m[pixel.s5], depth_m[pixel.s6], depth_m[pixel.s7], depth_m[pixel.s8], depth_m[pixel.s9],
                  depth_m[pixel.sa], depth_m[pixel.sb], depth_m[pixel.sc], depth_m[pixel.sd], depth_m[pixel.se],
                  depth_m[pixel.sf]);
    const float16 distance = (depth - camera_z) * (1.0f / truncation_m);
    const int16 update = inside & (depth > 0.0f) & (depth <= max_depth_m) & (distance > -1.0f);
    const int8 some = update.lo | update.hi;
    const int4 fewer = some.lo | some.hi;
    if ((fewer.x | fewer.y | fewer.z | fewer.w) == 0) continue;
    const float16 seen = update ? (distance < 1.0f ? distance : 1.0f) * 32767.0f : 0.0f;
    const uint16 old = voxels[index];
    voxels[index] = update ? average(old, seen, max_weight) : old;
  }
  empty[number] = free_rows == BRICK_VOXELS / 16;
}
