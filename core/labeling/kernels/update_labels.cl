// Label cloud update (thesis, Algorithms 1 and 2), turned inside out. The algorithm visits every voxel of space:
//   v_g = (voxel + 0.5) * voxel_size, seen in pixel u = floor(K (T_camera_world v_g) + 0.5) with depth > 0;
//   where |V_t(u) - v_g| < reach and S_cloud,t(u) != 0 the voxel takes S_cloud,t(u).
// A voxel is seen in one pixel at most, and only voxels within reach of that pixel's vertex are written: so visit those from
// the pixel, and write those that are seen in it. The result is the same, and no voxel is written twice.
// With confidence: a voxel that holds the same fragment gains one (up to the cap), one of another loses one and
// changes at zero, or at once where LABEL_AT_ONCE says so; without: it is overwritten.
// One work-item: one pixel.
//   vertices         pixels x float4, world, w = 0: no surface
//   new_labels       pixels, S_cloud,t as fragments, with LABEL_AT_ONCE
//   labels           slots x 512 label voxels, in/out; every brick within reach exists
//   fragment_voxels  voxels that hold each fragment, in/out
//   stamps           slots, in/out: number of the update in which the slot was last listed, so that it is listed once
//   touched, count   out: slots in which a voxel was visited
#include "core/compute/kernels/common.clh"
#include "core/fusion/kernels/brick_lookup.clh"
#include "core/labeling/kernels/label_voxel.h"

inline uint changed_voxel(const uint voxel, const uint new_label, const int use_confidence) {
  const uint label = new_label & LABEL_MAX;
  const uint held = LABEL_OF(voxel);
  const uint confidence = CONFIDENCE_OF(voxel);
  if (!use_confidence || held == 0u) return LABEL_VOXEL(label, 1u);
  if (held == label) return LABEL_VOXEL(held, min(confidence + 1u, LABEL_CONFIDENCE_MAX));
  const bool gives_way = confidence <= 1u || (new_label & LABEL_AT_ONCE) != 0u;
  return gives_way ? LABEL_VOXEL(label, 1u) : LABEL_VOXEL(held, confidence - 1u);
}

kernel void update_labels(global const float4* vertices, global const uint* new_labels,
                          global const BrickEntry* table, const uint mask, const float16 T_camera_world,
                          const float4 K, const int width, const int height, const float voxel_size,
                          const float reach, const int use_confidence, const int stamp, global uint* labels,
                          volatile global int* fragment_voxels, volatile global int* stamps,
                          volatile global int* count, global int* touched) {
  const int pixel = get_global_id(0);
  if (pixel >= width * height) return;
  const float4 vertex = vertices[pixel];
  const uint label = new_labels[pixel];
  if (!(vertex.w > 0.0f) || label == 0u) return;
  const float column = (float)(pixel % width);
  const float row = (float)(pixel / width);

  // Voxels whose centres may lie within reach, along each axis; a little more against rounding. Two or three of them for a
  // reach of one voxel.
  const float per_metre = 1.0f / voxel_size;
  const float around = reach * per_metre + 1e-3f;
  const float3 at = (float3)(vertex.x, vertex.y, vertex.z) * per_metre - 0.5f;
  const int x0 = (int)ceil(at.x - around), x1 = (int)floor(at.x + around);
  const int y0 = (int)ceil(at.y - around), y1 = (int)floor(at.y + around);
  const int z0 = (int)ceil(at.z - around), z1 = (int)floor(at.z + around);
  int bx = 0, by = 0, bz = 0, slot = BRICK_NONE;
  for (int z = z0; z <= z1; ++z) {
    const float dz = vertex.z - ((float)z + 0.5f) * voxel_size;
    for (int y = y0; y <= y1; ++y) {
      const float dy = vertex.y - ((float)y + 0.5f) * voxel_size;
      if (!(dy * dy + dz * dz < reach * reach)) continue;
      for (int x = x0; x <= x1; ++x) {
        const float3 v_g = ((float3)((float)x, (float)y, (float)z) + 0.5f) * voxel_size;
        const float dx = vertex.x - v_g.x;
        if (!(dx * dx + dy * dy + dz * dz < reach * reach)) continue;
        const float3 p = transform_point(T_camera_world, v_g);
        if (!(p.z > 0.0f)) continue;
        if (floor(K.x * p.x / p.z + K.z + 0.5f) != column || floor(K.y * p.y / p.z + K.w + 0.5f) != row) continue;
        if (slot == BRICK_NONE || bx != x >> BRICK_SHIFT || by != y >> BRICK_SHIFT || bz != z >> BRICK_SHIFT) {
          bx = x >> BRICK_SHIFT;
          by = y >> BRICK_SHIFT;
          bz = z >> BRICK_SHIFT;
          slot = find_brick(table, mask, bx, by, bz);
          if (slot == BRICK_NONE) continue;
          if (stamps[slot] != stamp && atomic_xchg(stamps + slot, stamp) != stamp) touched[atomic_inc(count)] = slot;
        }
        global uint* voxel = labels + slot * BRICK_VOXELS + (x & 7) + 8 * ((y & 7) + 8 * (z & 7));
        const uint before = *voxel;
        const uint after = changed_voxel(before, label, use_confidence);
        *voxel = after;
        if (LABEL_OF(before) != LABEL_OF(after)) {
          if (LABEL_OF(before) != 0u) atomic_dec(fragment_voxels + LABEL_OF(before));
          atomic_inc(fragment_voxels + LABEL_OF(after));
        }
      }
    }
  }
}
