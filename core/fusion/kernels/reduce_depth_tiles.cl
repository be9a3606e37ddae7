// farthest(tile) = the largest depth reading of a tile of TILE x TILE pixels (a build option), 0 where it has none.
//
// One work-item: one tile. depth_m: width * height metres, readings beyond max_depth_m do not count. farthest: one float a tile,
// row by row, ceil(width / TILE) a row.
kernel void reduce_depth_tiles(global const float* depth_m, const int width, const int height, const float max_depth_m,
                               global float* farthest) {
  const int tiles_x = (width + TILE - 1) / TILE;
  const int tx = (int)get_global_id(0);
  const int ty = (int)get_global_id(1);
  if (tx >= tiles_x || ty * TILE >= height) return;
  const int right = min(width, (tx + 1) * TILE);
  const int bottom = min(height, (ty + 1) * TILE);
  float largest = 0.0f;
  for (int v = ty * TILE; v < bottom; ++v) {
    for (int u = tx * TILE; u < right; ++u) {
      const float z = depth_m[v * width + u];
      largest = (z > largest && z <= max_depth_m) ? z : largest;
    }
  }
  farthest[ty * tiles_x + tx] = largest;
}
