#include "core/fusion/kernels/brick_field.clh"

// missing(group) = 1 if the band [z - truncation, z + truncation] around the depth reading of one of the group's sixteen pixels
// touches a brick that does not exist yet, else 0: the brick of the band's near end, and one more wherever it crosses a
// brick's face. BAND_CROSSINGS (a build option) = the most faces it can cross along one axis.
//
// One work-item: one group, sixteen neighbouring pixels of a row, one per vector lane; the last group of a row ends with it
// (and overlaps the one before). width >= 16. depth_m: width * height metres, anything outside of [depth_range.x,
// depth_range.y] is no reading. missing: ceil(width / 16) a row. T_window_camera: camera metres to voxels of the window.

// True where the band (near end a, direction d, per axis) crosses its k-th face of the first axis and the brick behind it
// does not exist; the order of the axes is told by `axis` (0: x first, 1: y first, 2: z first).
inline int16 misses_behind(const Field* field, const int axis, const int k, const float16 a, const float16 d,
                           const float16 a1, const float16 d1, const float16 a2, const float16 d2) {
  const int16 first = voxel_of(a) >> BRICK_SHIFT;
  const int16 brick = d > 0.0f ? first + k : first - k;
  const float16 face = convert_float16((d > 0.0f ? brick : brick + 1) << BRICK_SHIFT);
  const float16 t = (face - a) / d;
  const int16 crosses = (t > 0.0f) & (t <= 1.0f);
  if (!any16(crosses)) return 0;
  const int16 p = brick << BRICK_SHIFT;
  const int16 p1 = voxel_of(crosses ? a1 + t * d1 : a1);
  const int16 p2 = voxel_of(crosses ? a2 + t * d2 : a2);
  const int16 x = axis == 0 ? p : p1;
  const int16 y = axis == 1 ? p : (axis == 0 ? p1 : p2);
  const int16 z = axis == 2 ? p : p2;
  return crosses & (field_slot(field, field_page(field, x, y, z), x, y, z) < 0);
}

kernel void find_missing_bricks(global const float* depth_m, const int width, const int height, const float4 K,
                                const float16 T_window_camera, const float truncation_m, const float2 depth_range,
                                global const int* cells, global const int* page_slots, const int4 window_size,
                                global uchar* missing) {
  const int group = (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  const int groups = (width + 15) / 16;
  if (group >= groups || v >= height) return;
  const int u = min(16 * group, width - 16);
  const float16 reading = vload16(0, depth_m + v * width + u);
  const int16 valid = (reading >= depth_range.x) & (reading <= depth_range.y);
  int16 any = 0;
  if (any16(valid)) {
    const Field field = {cells, page_slots, 0, window_size};
    const float16 lane = (float16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const float16 T = T_window_camera;
    const float16 near_z = (valid ? reading : depth_range.x) - truncation_m;
    const float16 rx = (lane + (float)u - K.z) / K.x;
    const float ry = ((float)v - K.w) / K.y;
    const float16 wx = rx * T.s0 + (T.s1 * ry + T.s2);
    const float16 wy = rx * T.s4 + (T.s5 * ry + T.s6);
    const float16 wz = rx * T.s8 + (T.s9 * ry + T.sa);
    const float16 ax = T.s3 + near_z * wx;
    const float16 ay = T.s7 + near_z * wy;
    const float16 az = T.sb + near_z * wz;
    const float16 dx = 2.0f * truncation_m * wx;
    const float16 dy = 2.0f * truncation_m * wy;
    const float16 dz = 2.0f * truncation_m * wz;
    const int16 x = voxel_of(ax);
    const int16 y = voxel_of(ay);
    const int16 z = voxel_of(az);
    any = field_slot(&field, field_page(&field, x, y, z), x, y, z) < 0;
    for (int k = 1; k <= BAND_CROSSINGS; ++k) {
      any |= misses_behind(&field, 0, k, ax, dx, ay, dy, az, dz);
      any |= misses_behind(&field, 1, k, ay, dy, ax, dx, az, dz);
      any |= misses_behind(&field, 2, k, az, dz, ax, dx, ay, dy);
    }
  }
  missing[v * groups + group] = any16(valid & any) ? 1 : 0;
}
