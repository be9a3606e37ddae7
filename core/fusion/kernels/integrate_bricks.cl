#include "core/fusion/kernels/brick_layout.h"

// Averages a depth image into the signed distance of bricks (Curless and Levoy 1996):
//   sdf = D(pi(p)) - z(p),   d = min(sdf / truncation, 1)   for voxels with sdf > -truncation,
//   d' = (d W + d w) / (W + w),   W' = min(W + w, W_max),   w = 1 observation.
// D is read at the nearest pixel; z is along the optical axis, as depth cameras measure it.
//
// One work-item: two rows of 8 voxels along x as a float16 (PoCL does not vectorise this over work-items by itself).
// bricks: brick_count of (x, y, z, slot), counted from the window's first brick; 32 work-items each;
// `selected` (see select_bricks) says which stay as they are, and which are all free space, d = 1, without a look
// at the image.
// T_camera_window: voxels from the window's first to camera metres. depth_m: width * height metres; only readings in
// (0, max_depth_m] count. voxels: BRICK_VOXELS a slot, TsdfVoxel as one uint (distance low, weight high).
#define WEIGHT_ONE 256.0f

kernel void integrate_bricks(global const int4* restrict bricks, const int brick_count,
                             global const uchar* restrict selected, const float16 T_camera_window, const float4 K,
                             const int width, const int height, global const float* restrict depth_m,
                             const float max_depth_m, const float truncation_m, const float max_weight,
                             global uint16* restrict voxels) {
  const int pair = (int)get_global_id(0) & 31;
  const int number = (int)get_global_id(0) >> 5;
  if (number >= brick_count || selected[number] == 0) return;
  const int4 brick = bricks[number];
  int16 update = -1;
  float16 seen = 32767.0f; /* free space */
  if (selected[number] == 1) {
    const float x = (float)(BRICK_SIDE * brick.x) + 0.5f;
    const float y = (float)(BRICK_SIDE * brick.y + 2 * (pair & 3)) + 0.5f;
    const float z = (float)(BRICK_SIDE * brick.z + (pair >> 2)) + 0.5f;
    const float16 right = (float16)(0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7);
    const float16 down = (float16)(0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1);
    const float16 T = T_camera_window;
    const float16 camera_x = right * T.s0 + (down * T.s1 + (T.s0 * x + T.s1 * y + T.s2 * z + T.s3));
    const float16 camera_y = right * T.s4 + (down * T.s5 + (T.s4 * x + T.s5 * y + T.s6 * z + T.s7));
    const float16 camera_z = right * T.s8 + (down * T.s9 + (T.s8 * x + T.s9 * y + T.sa * z + T.sb));

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
    update = inside & (depth > 0.0f) & (depth <= max_depth_m) & (distance > -1.0f);
    const int8 some = update.lo | update.hi;
    const int4 fewer = some.lo | some.hi;
    if ((fewer.x | fewer.y | fewer.z | fewer.w) == 0) return;
    seen = update ? (distance < 1.0f ? distance : 1.0f) * 32767.0f : 0.0f;
  }

  const int index = brick.w * (BRICK_VOXELS / 16) + pair;
  const int16 old = as_int16(voxels[index]);
  const float16 old_distance = convert_float16((old << 16) >> 16);
  const float16 old_weight = convert_float16((old >> 16) & 0xffff);
  const float16 sum = old_weight + WEIGHT_ONE;
  const float16 mean = (old_distance * old_weight + seen * WEIGHT_ONE) / sum;
  // Rounds half up: mean is in [-32767, 32767].
  const int16 rounded = convert_int16(mean + 32768.5f) - 32768;
  const float16 weight = sum < max_weight ? sum : max_weight;
  const int16 fresh = (rounded & 0xffff) | (convert_int16(weight) << 16);
  voxels[index] = as_uint16(update ? fresh : old);
}
