// Averages a colour image into bricks. Voxels within `band` of the frame's surface (rate_pixels) take the running mean
//   c' = c + (c_seen - c) w / (W + w),   W' = min(W + w, COLOR_WEIGHT_MAX),
// of the colour at the nearest pixel of the colour image. Bytes hold integer levels, and plain rounding would lose small steps.
// So c' is rounded up or down by a hash of voxel and frame, which is correct on average and independent of the brick's slot.
// If the distance has at most FRESH observations, the surface is new or in doubt, and earlier colour weighs at most as much as
// that many views like this one.
//
// BRICK_ITEMS work-items: one brick, LANES voxels at a time, as in integrate_bricks.
// bricks: brick_count of (x, y, z, slot), counted from the brick `first` (w: number of the frame). T_camera_bricks,
// T_color_bricks: voxels from that brick to metres in the depth and colour camera. size: pixels of the depth camera; depths,
// ratings: one per cell of COLOR_CELL^2 of these pixels. image: color_size pixels of blue, green and red, plus one byte of padding.
// distances, weights, colors: BRICK_VOXELS per slot, brick_layout.h.
#include "core/compute/kernels/lanes.clh"
#include "core/fusion/kernels/brick_layout.h"
#include "core/fusion/kernels/brick_work.h"
#include "core/fusion/kernels/color_voxel.h"

#define FRESH 4.0f

// As brick_hash.
inline uintN hash_voxels(const uintN x, const uintN y, const uint z, const uint frame) {
  uintN h = x * 73856093u ^ y * 19349669u ^ (z * 83492791u ^ frame * 0x9e3779b9u);
  h ^= h >> 16;
  h *= 0x7feb352du;
  return h ^ (h >> 15);
}

// The mean of one channel, in bytes; `dither` in [0, 255].
inline uintN mean_color(const uintN before, const uintN seen, const floatN share, const uintN dither) {
  const floatN old = convert_floatN(as_intN(before));
  const floatN mean = old + (convert_floatN(as_intN(seen)) - old) * share;
  const floatN up = (convert_floatN(as_intN(dither)) + 0.5f) * (1.0f / 256.0f);
  return as_uintN(min(convert_intN(mean + up), (intN)(255)));
}

kernel void color_bricks(global const int4* restrict bricks, const int brick_count, const int4 first,
                         const float16 T_camera_bricks, const float4 K, const int2 size,
                         global const float* restrict depths, global const uint* restrict ratings,
                         const float16 T_color_bricks, const float4 K_color, const int2 color_size,
                         global const uchar* restrict image, const int band,
                         global const shortN* restrict distances, global const ucharN* restrict weights,
                         global uintN* restrict colors) {
  const int number = (int)get_global_id(0) / BRICK_ITEMS(LANES);
  if (number >= brick_count) return;
  const int4 brick = bricks[number];
  const float16 T = T_camera_bricks;
  const float16 C = T_color_bricks;
  const int columns = (size.x + COLOR_CELL - 1) / COLOR_CELL;

  int is_written = 0; /* any colour of the brick */
  for (int run = (int)get_global_id(0) % BRICK_ITEMS(LANES); run < BRICK_VOXELS / LANES; run += BRICK_ITEMS(LANES)) {
    const int index = brick.w * (BRICK_VOXELS / LANES) + run;
    const intN distance = convert_intN(distances[index]);
    const intN near = where(distance != DISTANCE_UNSEEN) & where(distance <= band) & where(distance >= -band);
    if (!any_lane(near)) continue;
    const int first_voxel = LANES * run;
    const intN column_x = LANE_X + (BRICK_SIDE * brick.x + (first_voxel & 7));
    const intN row_y = LANE_Y + (BRICK_SIDE * brick.y + ((first_voxel >> 3) & 7));
    const int row_z = BRICK_SIDE * brick.z + (first_voxel >> 6);
    const floatN x = convert_floatN(column_x) + 0.5f;
    const floatN y = convert_floatN(row_y) + 0.5f;
    const float z = (float)row_z + 0.5f;

    const floatN camera_z = x * T.s8 + y * T.s9 + (T.sa * z + T.sb);
    const floatN per_z = 1.0f / camera_z;
    const floatN u = (x * T.s0 + y * T.s1 + (T.s2 * z + T.s3)) * per_z * K.x + (K.z + 0.5f);
    const floatN v = (x * T.s4 + y * T.s5 + (T.s6 * z + T.s7)) * per_z * K.y + (K.w + 0.5f);
    const intN in_depth = near & where(camera_z > 0.0f) & where(u >= 0.0f) & where(u < (float)size.x) & where(v >= 0.0f) & where(v < (float)size.y);
    const intN cell = in_depth ? convert_intN(v) / COLOR_CELL * columns + convert_intN(u) / COLOR_CELL : 0;
    const floatN depth = GATHER(floatN, depths, cell);
    const uintN rating = GATHER(uintN, ratings, cell);
    const floatN reach = convert_floatN(as_intN(COLOR_RATING_REACH(rating))) * COLOR_REACH_STEP_M;
    const intN shown = in_depth & where(depth > 0.0f) & where(fabs(camera_z - depth) <= reach);
    if (!any_lane(shown)) continue;

    const floatN color_z = x * C.s8 + y * C.s9 + (C.sa * z + C.sb);
    const floatN per_color_z = 1.0f / color_z;
    const floatN s = (x * C.s0 + y * C.s1 + (C.s2 * z + C.s3)) * per_color_z * K_color.x + (K_color.z + 0.5f);
    const floatN t = (x * C.s4 + y * C.s5 + (C.s6 * z + C.s7)) * per_color_z * K_color.y + (K_color.w + 0.5f);
    const intN seen = shown & where(color_z > 0.0f) & where(s >= 0.0f) & where(s < (float)color_size.x) & where(t >= 0.0f) & where(t < (float)color_size.y);
    if (!any_lane(seen)) continue;
    const intN byte = seen ? 3 * (convert_intN(t) * color_size.x + convert_intN(s)) : 0;
    // Blue, green and red from the lowest byte on; the highest byte belongs to the next pixel.
    const uintN bgr = GATHER_BYTES(image, byte);
    const floatN weight = seen ? convert_floatN(as_intN(COLOR_RATING_WEIGHT(rating))) : 1.0f;

    if (!is_written) write_before_read((volatile global uint*)(colors + index));
    is_written = 1;
    const uintN old = colors[index];
    const floatN held = convert_floatN(as_intN(COLOR_WEIGHT(old)));
    const floatN observations = convert_floatN(convert_intN(weights[index]));
    const floatN alike = weight * observations;
    const floatN before = ((observations < FRESH) & (alike < held)) ? alike : held;
    const floatN sum = before + weight;
    const uintN dither = hash_voxels(as_uintN(column_x + BRICK_SIDE * first.x), as_uintN(row_y + BRICK_SIDE * first.y),
                                     (uint)(row_z + BRICK_SIDE * first.z), (uint)first.w);
    const floatN share = weight / sum;
    const uintN fresh = COLOR_VOXEL(mean_color(COLOR_RED(old), (bgr >> 16) & 255u, share, dither & 255u),
                                    mean_color(COLOR_GREEN(old), (bgr >> 8) & 255u, share, (dither >> 8) & 255u),
                                    mean_color(COLOR_BLUE(old), bgr & 255u, share, (dither >> 16) & 255u),
                                    as_uintN(convert_intN(sum < COLOR_WEIGHT_MAX ? sum : COLOR_WEIGHT_MAX)));
    colors[index] = seen ? fresh : old;
  }
}
