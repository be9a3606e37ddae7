// Lists the labelled voxels near the surface of bricks, for display and export: seen voxels whose signed distance is at most
// `band` (in 1/32767 of the truncation). Runs twice: with write = 0 to count, and with write = 1 after the counts are summed to
// offsets. One work-item: one brick, so that its points are contiguous.
//   normal    gradient of the distance along each axis: the central difference, or the one-sided difference if the other
//             neighbour is unseen or in another brick; 0 if both are
//   height    the distance divided by its slope: at oblique views, voxels are nearer to the surface than along rays
//   listed    bricks to visit: position x, y, z and slot
//   distances slots x 512 signed distances
//   labels    slots x 512 label voxels
//   colors    slots x 512 colour voxels
//   offsets   listed_count; write = 0, out: points of the brick; write = 1, in: index of its first point
//   points    all points, out
#include "core/fusion/kernels/brick_layout.h"
#include "core/labeling/kernels/label_voxel.h"

// Slope at voxel i, the `place`-th of its row, along the axis with an index step of `step` in `brick`.
inline float slope_at(global const short* brick, const int i, const int step, const int place) {
  const int low = place > 0 && brick[i - step] != DISTANCE_UNSEEN ? i - step : i;
  const int high = place < BRICK_SIDE - 1 && brick[i + step] != DISTANCE_UNSEEN ? i + step : i;
  if (low == high) return 0.0f;
  const float apart = low < i && high > i ? 2.0f : 1.0f;
  return ((float)brick[high] - (float)brick[low]) / apart;
}

kernel void extract_points(global const int4* listed, const int listed_count,
                           global const short* distances, global const uint* labels, global const uint* colors,
                           const float voxel_size, const int band, const int write, global int* offsets,
                           global LabelPoint* points) {
  const int item = get_global_id(0);
  if (item >= listed_count) return;
  const int4 brick = listed[item];
  const int slot = brick.w;
  global const short* held = distances + slot * BRICK_VOXELS;
  global LabelPoint* out = points + (write ? offsets[item] : 0);
  int count = 0;
  for (int i = 0; i < BRICK_VOXELS; ++i) {
    const uint label = LABEL_OF(labels[slot * BRICK_VOXELS + i]);
    const int distance = held[i];
    if (label == 0u || distance == DISTANCE_UNSEEN || abs(distance) > (uint)band) continue;
    if (write) {
      const int x = i & 7;
      const int y = (i >> 3) & 7;
      const int z = i >> 6;
      out[count].x = ((float)(8 * brick.x + x) + 0.5f) * voxel_size;
      out[count].y = ((float)(8 * brick.y + y) + 0.5f) * voxel_size;
      out[count].z = ((float)(8 * brick.z + z) + 0.5f) * voxel_size;
      out[count].fragment = label;
      const float3 slope = (float3)(slope_at(held, i, 1, x), slope_at(held, i, 8, y), slope_at(held, i, 64, z));
      const float square = dot(slope, slope);
      const float flatness = square > 0.0f ? 1.0f / sqrt(square) : 0.0f;
      const float3 normal = slope * flatness;
      out[count].normal_x = normal.x;
      out[count].normal_y = normal.y;
      out[count].normal_z = normal.z;
      out[count].color = colors[slot * BRICK_VOXELS + i];
      out[count].height = (float)distance * flatness;
    }
    ++count;
  }
  if (!write) offsets[item] = count;
}
