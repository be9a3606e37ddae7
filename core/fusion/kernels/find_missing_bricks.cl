#include "core/fusion/kernels/brick_field.clh"

// missing(group) = 1 if the band [z - truncation, z + truncation] around the depth reading of one of the group's pixels
// touches a missing brick, else 0. The band touches the brick of its near end and one more at each brick face it crosses;
// `crossings` = the largest number of faces it can cross along one axis.
//
// One work-item: one group, LANES neighbouring pixels of a row. The last group ends with the row and may overlap the one
// before. width >= LANES. depth_m: width * height metres, values outside [depth_range.x,
// depth_range.y] are no readings. missing: ceil(width / LANES) per row. T_window_camera: camera metres to voxels of the window.

// True where the band (near end a, direction d, per axis) crosses its k-th face of the first axis and the brick behind it
// is missing. `axis` is the first axis (0: x, 1: y, 2: z).
inline intN misses_behind(const Field* field, const int axis, const int k, const floatN a, const floatN d,
                           const floatN a1, const floatN d1, const floatN a2, const floatN d2) {
  const intN first = voxel_of(a) >> BRICK_SHIFT;
  const intN brick = d > 0.0f ? first + k : first - k;
  const floatN face = convert_floatN((d > 0.0f ? brick : brick + 1) << BRICK_SHIFT);
  const floatN t = (face - a) / d;
  const intN crosses = where(t > 0.0f) & where(t <= 1.0f);
  if (!any_lane(crosses)) return 0;
  const intN p = brick << BRICK_SHIFT;
  const intN p1 = voxel_of(crosses ? a1 + t * d1 : a1);
  const intN p2 = voxel_of(crosses ? a2 + t * d2 : a2);
  const intN x = axis == 0 ? p : p1;
  const intN y = axis == 1 ? p : (axis == 0 ? p1 : p2);
  const intN z = axis == 2 ? p : p2;
  return crosses & (field_slot(field, field_page(field, x, y, z), x, y, z) < 0);
}

kernel void find_missing_bricks(global const float* depth_m, const int width, const int height, const float4 K,
                                const float16 T_window_camera, const float truncation_m, const float2 depth_range,
                                global const int* cells, global const int* page_slots, const int4 window_size,
                                const int crossings, global uchar* missing) {
  const int group = (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  const int groups = (width + LANES - 1) / LANES;
  if (group >= groups || v >= height) return;
  const int u = min(LANES * group, width - LANES);
  const floatN reading = LOAD(depth_m + v * width + u);
  const intN valid = where(reading >= depth_range.x) & where(reading <= depth_range.y);
  intN any = 0;
  if (any_lane(valid)) {
    const Field field = {cells, page_slots, 0, window_size};
    const floatN lane = convert_floatN(LANE);
    const float16 T = T_window_camera;
    const floatN near_z = (valid ? reading : depth_range.x) - truncation_m;
    const floatN rx = (lane + (float)u - K.z) / K.x;
    const float ry = ((float)v - K.w) / K.y;
    const floatN wx = rx * T.s0 + (T.s1 * ry + T.s2);
    const floatN wy = rx * T.s4 + (T.s5 * ry + T.s6);
    const floatN wz = rx * T.s8 + (T.s9 * ry + T.sa);
    const floatN ax = T.s3 + near_z * wx;
    const floatN ay = T.s7 + near_z * wy;
    const floatN az = T.sb + near_z * wz;
    const floatN dx = 2.0f * truncation_m * wx;
    const floatN dy = 2.0f * truncation_m * wy;
    const floatN dz = 2.0f * truncation_m * wz;
    const intN x = voxel_of(ax);
    const intN y = voxel_of(ay);
    const intN z = voxel_of(az);
    any = field_slot(&field, field_page(&field, x, y, z), x, y, z) < 0;
    for (int k = 1; k <= crossings; ++k) {
      any |= misses_behind(&field, 0, k, ax, dx, ay, dy, az, dz);
      any |= misses_behind(&field, 1, k, ay, dy, ax, dx, az, dz);
      any |= misses_behind(&field, 2, k, az, dz, ax, dx, ay, dy);
    }
  }
  missing[v * groups + group] = any_lane(valid & any) ? 1 : 0;
}
