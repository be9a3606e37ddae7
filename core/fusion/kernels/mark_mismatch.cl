// Surface with readings behind it has probably been removed. Lowers its weight, so that the next frames decide.
// For each pixel under the mask with a reading behind the map's surface by more than apart_m, all voxels next to the ray within
// reach of that surface keep a weight of at most MISMATCH_WEIGHT.
// One work-item: one pixel of the surface, which has the size of the launch. Work-items may share a voxel; all write the same value.
//   mask         mask_width * mask_height, as in leave_out_moving
//   readings     camera frame, w = 0: none; vertices: world, w = 0: no surface
//   apart        (metres, metres per z^2), z of the reading
//   weights      slots x 512 observations, in/out
#include "core/compute/kernels/common.clh"
#include "core/fusion/kernels/brick_lookup.clh"

#define MISMATCH_WEIGHT 2 /* observations */

kernel void mark_mismatch(global const uchar* mask, const int mask_width, const int mask_height,
                          global const float4* readings, global const float4* vertices,
                          const float16 T_camera_world, const float4 eye, const float2 apart,
                          const float voxel_size, const float reach, global const BrickEntry* table,
                          const uint table_mask, global uchar* weights) {
  const int column = (int)get_global_id(0);
  const int row = (int)get_global_id(1);
  const int width = (int)get_global_size(0);
  const int pixel = row * width + column;
  const int x = column * mask_width / width;
  const int y = row * mask_height / (int)get_global_size(1);
  if (mask[y * mask_width + x] == 0) return;
  const float4 vertex = vertices[pixel];
  const float4 reading = readings[pixel];
  if (!(vertex.w > 0.0f) || !(reading.w > 0.0f)) return;
  const float z = transform_point(T_camera_world, vertex.xyz).z;
  if (!(reading.z - z > apart.x + apart.y * reading.z * reading.z)) return;

  const float3 along = normalize(vertex.xyz - eye.xyz);
  const int steps = (int)ceil(2.0f * reach / voxel_size);
  for (int step = -steps; step <= steps; ++step) {
    const float3 p = (vertex.xyz + along * (0.5f * (float)step * voxel_size)) / voxel_size - 0.5f;
    const int3 first = convert_int3(floor(p));
    for (int corner = 0; corner < 8; ++corner) {
      const int3 v = first + (int3)(corner & 1, (corner >> 1) & 1, corner >> 2);
      const int slot =
          find_brick(table, table_mask, v.x >> BRICK_SHIFT, v.y >> BRICK_SHIFT, v.z >> BRICK_SHIFT);
      if (slot == BRICK_NONE) continue;
      global uchar* weight = weights + slot * BRICK_VOXELS + (v.x & 7) + 8 * ((v.y & 7) + 8 * (v.z & 7));
      if (*weight > MISMATCH_WEIGHT) *weight = MISMATCH_WEIGHT;
    }
  }
}
