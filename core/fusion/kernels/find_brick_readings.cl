// readings(brick) = (smallest, largest) depth reading to which its voxels may project: bounds from the tiles that the projected
// corners span. Smallest is 0 if some voxel may have no reading, largest is 0 if none has one.
//
// One work-item: one brick, its corners in a float8. bricks: brick_count of (x, y, z, slot), counted from the window's first
// brick. T_camera_window: voxels from the window's first to camera metres. extents: see reduce_depth_tiles.
// readings: brick_count, metres.
#include "core/fusion/kernels/depth_tiles.h"

#define NEAR_M 0.01f

inline float smallest(const float8 a) {
  const float4 b = fmin(a.lo, a.hi);
  return fmin(fmin(b.x, b.y), fmin(b.z, b.w));
}

kernel void find_brick_readings(global const int4* bricks, const int brick_count, const float16 T_camera_window,
                                const float4 K, const int width, const int height, global const float2* extents,
                                const float max_depth_m, global float2* readings) {
  const int i = (int)get_global_id(0);
  if (i >= brick_count) return;
  const float16 T = T_camera_window;
  const float8 x = (float)(8 * bricks[i].x) + (float8)(0, 8, 0, 8, 0, 8, 0, 8);
  const float8 y = (float)(8 * bricks[i].y) + (float8)(0, 0, 8, 8, 0, 0, 8, 8);
  const float8 z = (float)(8 * bricks[i].z) + (float8)(0, 0, 0, 0, 8, 8, 8, 8);
  const float8 camera_x = T.s0 * x + T.s1 * y + T.s2 * z + T.s3;
  const float8 camera_y = T.s4 * x + T.s5 * y + T.s6 * z + T.s7;
  const float8 camera_z = T.s8 * x + T.s9 * y + T.sa * z + T.sb;
  const float nearest = smallest(camera_z);
  if (!(nearest > NEAR_M)) {
    readings[i] = (float2)(0.0f, max_depth_m); /* around the camera: no bounds */
    return;
  }
  const float8 u = camera_x / camera_z * K.x + (K.z + 0.5f);
  const float8 v = camera_y / camera_z * K.y + (K.w + 0.5f);
  const float left = smallest(u);
  const float right = -smallest(-u);
  const float top = smallest(v);
  const float bottom = -smallest(-v);
  float2 reading = (float2)(max_depth_m, 0.0f);
  if (right >= 0.0f && left < (float)width && bottom >= 0.0f && top < (float)height) {
    const int tiles_x = DEPTH_TILES(width);
    const int first_x = (int)fmax(left, 0.0f) / DEPTH_TILE;
    const int first_y = (int)fmax(top, 0.0f) / DEPTH_TILE;
    const int last_x = (int)fmin(right, (float)(width - 1)) / DEPTH_TILE;
    const int last_y = (int)fmin(bottom, (float)(height - 1)) / DEPTH_TILE;
    for (int ty = first_y; ty <= last_y; ++ty) {
      for (int tx = first_x; tx <= last_x; ++tx) {
        const float2 extent = extents[ty * tiles_x + tx];
        reading.x = fmin(reading.x, extent.x);
        reading.y = fmax(reading.y, extent.y);
      }
    }
  }
  const int inside = left >= 0.0f && right < (float)width && top >= 0.0f && bottom < (float)height;
  readings[i] = inside ? reading : (float2)(0.0f, reading.y);
}
