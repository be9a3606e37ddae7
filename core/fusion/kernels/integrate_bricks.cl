#include "core/compute/kernels/lanes.clh"
#include "core/fusion/kernels/brick_layout.h"
#include "core/fusion/kernels/brick_work.h"

// Averages a depth image into the signed distance of bricks (Curless and Levoy 1996):
//   sdf = D(pi(p)) - z(p),   d = min(sdf / truncation, 1)   for voxels with sdf > -truncation,
//   d' = (d W + d w) / (W + w),   W' = min(W + w, W_max),   w = 1 observation.
// D is read at the nearest pixel; z is along the optical axis, as depth cameras measure it.
//
// BRICK_ITEMS work-items (a work-group if several): one brick, LANES voxels at a time.
// bricks: brick_count of (x, y, z, slot), counted from the window's first brick.
// readings: bounds of the readings of each brick (see find_brick_readings). With them, most voxels behind the surface (unchanged)
// or in front of it (free space, d = 1) need no access to the image.
// T_camera_window: voxels from the window's first to camera metres. depth_m: width * height metres; only readings in
// (0, max_depth_m] count. distances, weights: BRICK_VOXELS per slot, brick_layout.h.
// empty(brick) = 1 if the image shows free space in all of it (no reading's band touches it) and no voxel's average is within
// half a truncation of a surface; else 0.
#define ROUNDING_M 1e-4f
#define HALF_TRUNCATION 16384

typedef struct Voxels {
  intN distance;
  intN weight;
} Voxels;

// The running average of voxels with the new distances `seen`.
inline Voxels average(const Voxels old, const floatN seen, const int max_weight) {
  const floatN weight = convert_floatN(old.weight);
  const floatN mean = (convert_floatN(old.distance) * weight + seen) / (weight + 1.0f);
  // Rounds half up: mean is in [-32767, 32767].
  const intN rounded = convert_intN(mean + 32768.5f) - 32768;
  Voxels fresh;
  fresh.distance = rounded == DISTANCE_UNSEEN ? (intN)(DISTANCE_UNSEEN + 1) : rounded;
  fresh.weight = min(old.weight + 1, (intN)(max_weight));
  return fresh;
}

// Returns the number of runs of LANES voxels of the work-item that are entirely free space.
inline int integrate_brick(const int4 brick, const int item, const float2 reading, const float16 T, const float4 K,
                           const int width, const int height, global const float* restrict depth_m,
                           const float max_depth_m, const float truncation_m, const int max_weight,
                           global shortN* restrict distances, global ucharN* restrict weights) {
  if (reading.y == 0.0f) return 0;
  const float behind = reading.y + truncation_m + ROUNDING_M;
  const float in_front = reading.x - truncation_m - ROUNDING_M;
  const float centre_to_corner = 0.5f * (fabs(T.s8) + fabs(T.s9) + fabs(T.sa));
  const float x = (float)(BRICK_SIDE * brick.x) + 0.5f;
  const float y = (float)(BRICK_SIDE * brick.y) + 0.5f;
  const float z = (float)(BRICK_SIDE * brick.z) + 0.5f;
  const float first_x = T.s0 * x + T.s1 * y + T.s2 * z + T.s3;
  const float first_y = T.s4 * x + T.s5 * y + T.s6 * z + T.s7;
  const float first_z = T.s8 * x + T.s9 * y + T.sa * z + T.sb;
  const floatN right = convert_floatN(LANE_X);
  const floatN down = convert_floatN(LANE_Y);
  const floatN run_x = right * T.s0 + down * T.s1;
  const floatN run_y = right * T.s4 + down * T.s5;
  const floatN run_z = right * T.s8 + down * T.s9;
  const float nearest_of_run = fmin((float)(LANES_X - 1) * T.s8, 0.0f) + fmin((float)(LANES_Y - 1) * T.s9, 0.0f);
  const float farthest_of_run = fmax((float)(LANES_X - 1) * T.s8, 0.0f) + fmax((float)(LANES_Y - 1) * T.s9, 0.0f);

  int free_runs = 0;
  for (int run = item; run < BRICK_VOXELS / LANES; run += BRICK_ITEMS(LANES)) {
    const int first = LANES * run;           /* its first voxel */
    const float column = (float)(first & 7); /* 0 where a run holds whole rows */
    const float row_y = (float)((first >> 3) & 7);
    const float row_z = (float)(first >> 6);
    const float start_x = LANES < 8 ? first_x + T.s0 * column : first_x;
    const float start_y = LANES < 8 ? first_y + T.s4 * column : first_y;
    const float start_z = LANES < 8 ? first_z + T.s8 * column : first_z;
    const float camera_first_z = start_z + T.s9 * row_y + T.sa * row_z;
    if (camera_first_z + nearest_of_run > behind) continue;
    const int index = brick.w * (BRICK_VOXELS / LANES) + run;
    if (camera_first_z + farthest_of_run < in_front) {
      const Voxels old = {convert_intN(distances[index]), convert_intN(weights[index])};
      const Voxels fresh = average(old, (float)DISTANCE_ONE, max_weight);
      distances[index] = convert_shortN(fresh.distance);
      weights[index] = convert_ucharN(fresh.weight);
      const intN near = fresh.distance < HALF_TRUNCATION;
      const int far_off = camera_first_z + farthest_of_run + centre_to_corner < in_front;
      if (far_off && !any_lane(near)) ++free_runs;
      continue;
    }
    const floatN camera_x = run_x + (start_x + T.s1 * row_y + T.s2 * row_z);
    const floatN camera_y = run_y + (start_y + T.s5 * row_y + T.s6 * row_z);
    const floatN camera_z = run_z + camera_first_z;
    const floatN inverse_z = 1.0f / camera_z;
    const floatN u = camera_x * inverse_z * K.x + (K.z + 0.5f);
    const floatN v = camera_y * inverse_z * K.y + (K.w + 0.5f);
    const intN inside = where(camera_z > 0.0f) & where(u >= 0.0f) & where(u < (float)width) & where(v >= 0.0f) & where(v < (float)height);
    const intN pixel = convert_intN(inside ? v : 0.0f) * width + convert_intN(inside ? u : 0.0f);
    const floatN depth = GATHER_NEAR(floatN, depth_m, pixel);
    const floatN distance = (depth - camera_z) * (1.0f / truncation_m);
    const intN update = inside & where(depth > 0.0f) & where(depth <= max_depth_m) & where(distance > -1.0f);
    if (!any_lane(update)) continue;
    const floatN seen = update ? (distance < 1.0f ? distance : 1.0f) * DISTANCE_ONE : 0.0f;
    const Voxels old = {convert_intN(distances[index]), convert_intN(weights[index])};
    const Voxels fresh = average(old, seen, max_weight);
    distances[index] = convert_shortN(update ? fresh.distance : old.distance);
    weights[index] = convert_ucharN(update ? fresh.weight : old.weight);
  }
  return free_runs;
}

kernel void integrate_bricks(global const int4* restrict bricks, const int brick_count,
                             global const float2* restrict readings, const float16 T_camera_window, const float4 K,
                             const int width, const int height, global const float* restrict depth_m,
                             const float max_depth_m, const float truncation_m, const int max_weight,
                             global shortN* restrict distances, global ucharN* restrict weights,
                             global uchar* restrict empty) {
  const int number = (int)get_global_id(0) / BRICK_ITEMS(LANES);
  const int item = (int)get_global_id(0) % BRICK_ITEMS(LANES);
  int free_runs = 0;
  if (number < brick_count) {
    free_runs = integrate_brick(bricks[number], item, readings[number], T_camera_window, K, width, height, depth_m,
                                max_depth_m, truncation_m, max_weight, distances, weights);
  }
#if BRICK_ITEMS(LANES) == 1
  if (number < brick_count) empty[number] = free_runs == BRICK_VOXELS / LANES;
#else
  local int free_of_brick;
  if (item == 0) free_of_brick = 0;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (free_runs > 0) atomic_add(&free_of_brick, free_runs);
  barrier(CLK_LOCAL_MEM_FENCE);
  if (item == 0 && number < brick_count) empty[number] = free_of_brick == BRICK_VOXELS / LANES;
#endif
}
