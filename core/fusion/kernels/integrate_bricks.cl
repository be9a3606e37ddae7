#include "core/fusion/kernels/brick_layout.h"

// Averages a depth image into the signed distance of bricks (Curless and Levoy 1996):
//   sdf = D(pi(p)) - z(p),   d = min(sdf / truncation, 1)   for voxels with sdf > -truncation,
//   d' = (d W + d w) / (W + w),   W' = min(W + w, W_max),   w = 1 observation.
// D is read at the nearest pixel; z is along the optical axis, as depth cameras measure it.
//
// One work-item: one voxel; a work-group of BRICK_VOXELS: one brick. Straight-line code: PoCL vectorises over work-items.
// bricks: brick_count of (x, y, z, slot), counted from the window's first brick.
// T_camera_window: voxels from the window's first to camera metres. depth_m: width * height metres; only readings in
// (0, max_depth_m] count. voxels: BRICK_VOXELS a slot, TsdfVoxel as one uint (distance low, weight high).
#define WEIGHT_ONE 256.0f

kernel void integrate_bricks(global const int4* restrict bricks, const int brick_count, const float16 T_camera_window,
                             const float4 K, const int width, const int height, global const float* restrict depth_m,
                             const float max_depth_m, const float truncation_m, const float max_weight,
                             global uint* restrict voxels) {
  const int local_index = (int)get_local_id(0);
  const int4 brick = bricks[get_group_id(0)];
  const float x = (float)(BRICK_SIDE * brick.x + (local_index & 7)) + 0.5f;
  const float y = (float)(BRICK_SIDE * brick.y + ((local_index >> 3) & 7)) + 0.5f;
  const float z = (float)(BRICK_SIDE * brick.z + (local_index >> 6)) + 0.5f;
  const float camera_x = T_camera_window.s0 * x + T_camera_window.s1 * y + T_camera_window.s2 * z + T_camera_window.s3;
  const float camera_y = T_camera_window.s4 * x + T_camera_window.s5 * y + T_camera_window.s6 * z + T_camera_window.s7;
  const float camera_z = T_camera_window.s8 * x + T_camera_window.s9 * y + T_camera_window.sa * z + T_camera_window.sb;

  const float inverse_z = 1.0f / camera_z;
  const float u = K.x * camera_x * inverse_z + (K.z + 0.5f);
  const float v = K.y * camera_y * inverse_z + (K.w + 0.5f);
  const int inside =
      (camera_z > 0.0f) & (u >= 0.0f) & (u < (float)width) & (v >= 0.0f) & (v < (float)height);
  const int pixel = inside ? (int)v * width + (int)u : 0;
  const float depth = depth_m[pixel];
  const float distance = (depth - camera_z) / truncation_m;
  const int update = inside & (depth > 0.0f) & (depth <= max_depth_m) & (distance > -1.0f);

  const int index = brick.w * BRICK_VOXELS + local_index;
  const uint old = voxels[index];
  const float old_distance = (float)(short)(old & 0xffffu);
  const float old_weight = (float)(old >> 16);
  const float seen = update ? 32767.0f * (distance < 1.0f ? distance : 1.0f) : 0.0f;
  const float sum = old_weight + WEIGHT_ONE;
  const float mean = (old_distance * old_weight + seen * WEIGHT_ONE) / sum;
  // Rounds half up: mean is in [-32767, 32767].
  const int rounded = (int)(mean + 32768.5f) - 32768;
  const float weight = sum < max_weight ? sum : max_weight;
  const uint fresh = ((uint)rounded & 0xffffu) | ((uint)weight << 16);
  voxels[index] = update ? fresh : old;
}
