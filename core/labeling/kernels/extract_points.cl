// Labelled voxels near the surface of the listed bricks, for display and export: those that were seen and whose signed distance is
// at most `band` (in 1/32767 of the truncation). Run twice: first with write = 0 to count, then, with the counts summed up to
// offsets, with write = 1. One work-item: one brick, so that its points lie together.
//   listed    bricks to visit: position x, y, z and slot
//   voxels    slots x 512 signed distances
//   labels    slots x 512 label voxels
//   offsets   listed_count; write = 0, out: points of the brick; write = 1, in: where its points go
//   points    all points, out
#include "core/fusion/kernels/brick_layout.h"
#include "core/labeling/kernels/label_voxel.h"

kernel void extract_points(global const int4* listed, const int listed_count,
                           global const TsdfVoxel* voxels, global const uint* labels, const float voxel_size,
                           const int band, const int write, global int* offsets, global LabelPoint* points) {
  const int item = get_global_id(0);
  if (item >= listed_count) return;
  const int4 brick = listed[item];
  const int slot = brick.w;
  global LabelPoint* out = points + (write ? offsets[item] : 0);
  int count = 0;
  for (int i = 0; i < BRICK_VOXELS; ++i) {
    const uint label = LABEL_OF(labels[slot * BRICK_VOXELS + i]);
    const TsdfVoxel voxel = voxels[slot * BRICK_VOXELS + i];
    if (label == 0u || voxel.weight == 0 || abs((int)voxel.distance) > (uint)band) continue;
    if (write) {
      out[count].x = ((float)(8 * brick.x + (i & 7)) + 0.5f) * voxel_size;
      out[count].y = ((float)(8 * brick.y + ((i >> 3) & 7)) + 0.5f) * voxel_size;
      out[count].z = ((float)(8 * brick.z + (i >> 6)) + 0.5f) * voxel_size;
      out[count].fragment = label;
    }
    ++count;
  }
  if (!write) offsets[item] = count;
}
