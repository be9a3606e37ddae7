// extent(tile) = (smallest, largest) depth reading of a tile of DEPTH_TILE^2 pixels; smallest is 0 if a pixel
// has none, largest is 0 if no pixel has one.
//
// One work-item: one tile. depth_m: width * height metres, only values in (0, max_depth_m] are readings. extents: one pair per
// tile, row by row, DEPTH_TILES(width) per row.
#include "core/fusion/kernels/depth_tiles.h"

kernel void reduce_depth_tiles(global const float* depth_m, const int width, const int height, const float max_depth_m,
                               global float2* extents) {
  const int tiles_x = DEPTH_TILES(width);
  const int tx = (int)get_global_id(0);
  const int ty = (int)get_global_id(1);
  if (tx >= tiles_x || ty * DEPTH_TILE >= height) return;
  const int right = min(width, (tx + 1) * DEPTH_TILE);
  const int bottom = min(height, (ty + 1) * DEPTH_TILE);
  float largest = 0.0f;
  float smallest = max_depth_m;
  for (int v = ty * DEPTH_TILE; v < bottom; ++v) {
    for (int u = tx * DEPTH_TILE; u < right; ++u) {
      const float reading = depth_m[v * width + u];
      const float z = (reading > 0.0f && reading <= max_depth_m) ? reading : 0.0f;
      largest = z > largest ? z : largest;
      smallest = z < smallest ? z : smallest;
    }
  }
  extents[ty * tiles_x + tx] = (float2)(smallest, largest);
}
