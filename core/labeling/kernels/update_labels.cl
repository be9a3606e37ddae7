// Label cloud update (thesis, Algorithms 1 and 2) for the listed bricks:
//   v_g = (voxel + 0.5) * voxel_size, seen in pixel u = floor(K (T_camera_world v_g) + 0.5) with depth > 0;
//   where |V_t(u) - v_g| < reach and S_cloud,t(u) != 0 the voxel takes S_cloud,t(u).
// With confidence: a voxel of the same region gains one (up to the cap), of another loses one and
// changes at zero; without: it is overwritten.
// One work-item: one row of 8 voxels along x (64 rows a brick).
//   touched          slots to visit
//   positions        slots x int4, brick positions
//   vertices         pixels x float4, world, w = 0: no surface
//   new_labels       pixels, S_cloud,t as raw labels
//   region_of_label  region of each raw label
//   labels           slots x 512 label voxels, in/out
#include "core/compute/kernels/common.clh"
#include "core/fusion/kernels/brick_layout.h"
#include "core/labeling/kernels/label_voxel.h"

inline uint changed_voxel(const uint voxel, const uint label, const int use_confidence,
                          global const uint* region_of_label) {
  if (!use_confidence) return LABEL_VOXEL(label, 1u);
  const uint held = LABEL_OF(voxel);
  const uint confidence = CONFIDENCE_OF(voxel);
  if (held == 0u) return LABEL_VOXEL(label, 1u);
  if (region_of_label[held] == region_of_label[label]) {
    return LABEL_VOXEL(held, min(confidence + 1u, LABEL_CONFIDENCE_MAX));
  }
  return confidence > 1u ? LABEL_VOXEL(held, confidence - 1u) : LABEL_VOXEL(label, 1u);
}

kernel void update_labels(global const int* touched, const int touched_count, global const int4* positions,
                          global const float4* vertices, global const uint* new_labels,
                          global const uint* region_of_label, const float16 T_camera_world, const float4 K,
                          const int width, const int height, const float voxel_size, const float reach,
                          const int use_confidence, global uint* labels) {
  const int item = get_global_id(0);
  if (item >= touched_count * 64) return;
  const int slot = touched[item >> 6];
  const int row = item & 63;
  const int4 brick = positions[slot];
  const float3 first = (float3)((float)(8 * brick.x) + 0.5f, (float)(8 * brick.y + (row & 7)) + 0.5f,
                                (float)(8 * brick.z + (row >> 3)) + 0.5f) * voxel_size;
  global uint* row_labels = labels + slot * BRICK_VOXELS + 8 * row;
  for (int x = 0; x < 8; ++x) {
    const float3 v_g = (float3)(first.x + (float)x * voxel_size, first.y, first.z);
    const float3 p = transform_point(T_camera_world, v_g);
    if (!(p.z > 0.0f)) continue;
    const float u = floor(K.x * p.x / p.z + K.z + 0.5f);
    const float v = floor(K.y * p.y / p.z + K.w + 0.5f);
    if (!(u >= 0.0f && v >= 0.0f && u < (float)width && v < (float)height)) continue;
    const int pixel = (int)v * width + (int)u;
    const float4 vertex = vertices[pixel];
    const float3 offset = vertex.xyz - v_g;
    if (!(vertex.w > 0.0f && dot(offset, offset) < reach * reach)) continue;
    const uint label = new_labels[pixel];
    if (label == 0u) continue;
    row_labels[x] = changed_voxel(row_labels[x], label, use_confidence, region_of_label);
  }
}
