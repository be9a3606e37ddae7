// Averages a colour image into bricks: for voxels within `band` of the surface that the frame shows (rate_pixels), the
// running mean
//   c' = c + (c_seen - c) w / (W + w),   W' = min(W + w, COLOR_WEIGHT_MAX),
// of the colour at the nearest pixel of the colour image. A byte holds whole levels, of which a small step would be lost each
// time: c' is rounded up or down by a hash of voxel and frame, so that it is right on the average, and the same wherever the
// brick lies. Where the distance itself is but FRESH observations old, the surface is new or in doubt, and what was seen before
// counts no more than as many views like this one.
//
// One work-item: one brick, two rows of 8 voxels along x at a time as a float16, as in integrate_bricks.
// bricks: brick_count of (x, y, z, slot), counted from the brick `first` (w: number of the frame). T_camera_bricks,
// T_color_bricks: voxels from there to metres of the depth and of the colour camera. size: pixels of the depth camera; depths,
// ratings: by its cells of CELL * CELL pixels. image: color_size pixels of blue, green, red, and one more byte.
// voxels: BRICK_VOXELS a slot, TsdfVoxel as one uint (distance low, weight high); colors: likewise, color_voxel.h.
#include "core/fusion/kernels/brick_field.clh"
#include "core/fusion/kernels/color_voxel.h"

#define FRESH 4.0f

// Blue, green, red from the lowest byte on; in the highest what comes after them.
inline uint pixel_at(global const uchar* image, const int byte) { return as_uint(vload4(0, image + byte)); }

// As brick_hash.
inline uint16 hash16(const uint16 x, const uint16 y, const uint z, const uint frame) {
  uint16 h = x * 73856093u ^ y * 19349669u ^ (z * 83492791u ^ frame * 0x9e3779b9u);
  h ^= h >> 16;
  h *= 0x7feb352du;
  return h ^ (h >> 15);
}

// One channel's mean, a byte of each; `dither` in [0, 255].
inline uint16 mean16(const uint16 before, const uint16 seen, const float16 share, const uint16 dither) {
  const float16 old = convert_float16(as_int16(before));
  const float16 mean = old + (convert_float16(as_int16(seen)) - old) * share;
  const float16 up = (convert_float16(as_int16(dither)) + 0.5f) * (1.0f / 256.0f);
  return as_uint16(min(convert_int16(mean + up), (int16)(255)));
}

kernel void color_bricks(global const int4* restrict bricks, const int brick_count, const int4 first,
                         const float16 T_camera_bricks, const float4 K, const int2 size,
                         global const float* restrict depths, global const uint* restrict ratings,
                         const float16 T_color_bricks, const float4 K_color, const int2 color_size,
                         global const uchar* restrict image, const int band,
                         global const uint16* restrict voxels, global uint16* restrict colors) {
  const int number = (int)get_global_id(0);
  if (number >= brick_count) return;
  const int4 brick = bricks[number];
  const float16 T = T_camera_bricks;
  const float16 C = T_color_bricks;
  const int columns = (size.x + CELL - 1) / CELL;
  const int16 right = (int16)(0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7) + BRICK_SIDE * brick.x;
  const int16 down = (int16)(0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1) + BRICK_SIDE * brick.y;
  const float16 x = convert_float16(right) + 0.5f;

  for (int rows = 0; rows < BRICK_VOXELS / 16; ++rows) {
    const int index = brick.w * (BRICK_VOXELS / 16) + rows;
    const int16 voxel = as_int16(voxels[index]);
    const int16 distance = (voxel << 16) >> 16;
    const int16 observed = (voxel >> 16) & 0xffff;
    const int16 near = (observed != 0) & (distance <= band) & (distance >= -band);
    if (!any16(near)) continue;
    const int16 row_y = down + 2 * (rows & 3);
    const int row_z = BRICK_SIDE * brick.z + (rows >> 2);
    const float16 y = convert_float16(row_y) + 0.5f;
    const float z = (float)row_z + 0.5f;

    const float16 camera_z = x * T.s8 + y * T.s9 + (T.sa * z + T.sb);
    const float16 per_z = 1.0f / camera_z;
    const float16 u = (x * T.s0 + y * T.s1 + (T.s2 * z + T.s3)) * per_z * K.x + (K.z + 0.5f);
    const float16 v = (x * T.s4 + y * T.s5 + (T.s6 * z + T.s7)) * per_z * K.y + (K.w + 0.5f);
    const int16 in_depth = near & (camera_z > 0.0f) & (u >= 0.0f) & (u < (float)size.x) & (v >= 0.0f) & (v < (float)size.y);
    const int16 cell = in_depth ? convert_int16(v) / CELL * columns + convert_int16(u) / CELL : 0;
    const float16 depth = GATHER16(float16, depths, cell);
    const uint16 rating = GATHER16(uint16, ratings, cell);
    const float16 reach = convert_float16(as_int16(COLOR_RATING_REACH(rating))) * COLOR_REACH_STEP_M;
    const int16 shown = in_depth & (depth > 0.0f) & (fabs(camera_z - depth) <= reach);
    if (!any16(shown)) continue;

    const float16 color_z = x * C.s8 + y * C.s9 + (C.sa * z + C.sb);
    const float16 per_color_z = 1.0f / color_z;
    const float16 s = (x * C.s0 + y * C.s1 + (C.s2 * z + C.s3)) * per_color_z * K_color.x + (K_color.z + 0.5f);
    const float16 t = (x * C.s4 + y * C.s5 + (C.s6 * z + C.s7)) * per_color_z * K_color.y + (K_color.w + 0.5f);
    const int16 seen = shown & (color_z > 0.0f) & (s >= 0.0f) & (s < (float)color_size.x) & (t >= 0.0f) & (t < (float)color_size.y);
    if (!any16(seen)) continue;
    const int16 byte = seen ? 3 * (convert_int16(t) * color_size.x + convert_int16(s)) : 0;
    const uint16 bgr =
        (uint16)(pixel_at(image, byte.s0), pixel_at(image, byte.s1), pixel_at(image, byte.s2), pixel_at(image, byte.s3),
                 pixel_at(image, byte.s4), pixel_at(image, byte.s5), pixel_at(image, byte.s6), pixel_at(image, byte.s7),
                 pixel_at(image, byte.s8), pixel_at(image, byte.s9), pixel_at(image, byte.sa), pixel_at(image, byte.sb),
                 pixel_at(image, byte.sc), pixel_at(image, byte.sd), pixel_at(image, byte.se), pixel_at(image, byte.sf));
    const float16 weight = seen ? convert_float16(as_int16(COLOR_RATING_WEIGHT(rating))) : 1.0f;

    const uint16 old = colors[index];
    const float16 held = convert_float16(as_int16(COLOR_WEIGHT(old)));
    const float16 observations = convert_float16(observed) * (1.0f / 256.0f);
    const float16 alike = weight * observations;
    const float16 before = (observations < FRESH) & (alike < held) ? alike : held;
    const float16 sum = before + weight;
    const uint16 dither = hash16(as_uint16(right + BRICK_SIDE * first.x), as_uint16(row_y + BRICK_SIDE * first.y),
                                 (uint)(row_z + BRICK_SIDE * first.z), (uint)first.w);
    const float16 share = weight / sum;
    const uint16 fresh = COLOR_VOXEL(mean16(COLOR_RED(old), (bgr >> 16) & 255u, share, dither & 255u),
                                     mean16(COLOR_GREEN(old), (bgr >> 8) & 255u, share, (dither >> 8) & 255u),
                                     mean16(COLOR_BLUE(old), bgr & 255u, share, (dither >> 16) & 255u),
                                     as_uint16(convert_int16(sum < COLOR_WEIGHT_MAX ? sum : COLOR_WEIGHT_MAX)));
    colors[index] = seen ? fresh : old;
  }
}
