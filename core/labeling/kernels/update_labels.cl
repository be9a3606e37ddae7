// Label cloud update (thesis, Algorithms 1 and 2), turned inside out. The algorithm visits every voxel of space:
//   v_g = (voxel + 0.5) * voxel_size, seen in pixel u = floor(K (T_camera_world v_g) + 0.5) with depth > 0;
//   where |V_t(u) - v_g| < reach and S_cloud,t(u) != 0 the voxel takes S_cloud,t(u).
// A voxel is seen in one pixel at most, and only voxels within reach of that pixel's vertex are written: so visit those from
// the pixel, and write those that are seen in it. The result is the same, and no voxel is written twice.
// With confidence: a voxel that holds the same fragment gains one (up to the cap), one of another loses one and
// changes at zero, or at once where LABEL_AT_ONCE says so; without: it is overwritten.
// One work-item: LANES pixels, one after the other.
//   vertices         pixels x float4, world, w = 0: no surface
//   new_labels       pixels, S_cloud,t as fragments, with LABEL_AT_ONCE
//   labels           slots x 512 label voxels, in/out; every brick within reach exists
//   fragment_voxels  voxels that hold each fragment, in/out
//   stamps           slots, in/out: number of the update in which the slot was last listed, so that it is listed once
//   touched, count   out: slots in which a voxel was visited
#include "core/compute/kernels/common.clh"
#include "core/fusion/kernels/brick_lookup.clh"
#include "core/labeling/kernels/label_voxel.h"

#define SURELY_OFF 0.55f /* pixels from a pixel's centre: not seen in it, however the numbers are rounded */

inline uint changed_voxel(const uint voxel, const uint new_label, const int use_confidence) {
  const uint label = new_label & LABEL_MAX;
  const uint held = LABEL_OF(voxel);
  const uint confidence = CONFIDENCE_OF(voxel);
  if (!use_confidence || held == 0u) return LABEL_VOXEL(label, 1u);
  if (held == label) return LABEL_VOXEL(held, min(confidence + 1u, LABEL_CONFIDENCE_MAX));
  const bool gives_way = confidence <= 1u || (new_label & LABEL_AT_ONCE) != 0u;
  return gives_way ? LABEL_VOXEL(label, 1u) : LABEL_VOXEL(held, confidence - 1u);
}

// Whether the voxel with centre (x, y, z) is within reach of the vertex, and seen in the pixel (column, row). One number at a
// time: vectors of three are taken apart and put together again all the time.
inline bool is_of_pixel(const float x, const float y, const float z, const float4 vertex, const float reach_squared,
                        const float16 T, const float4 K, const float column, const float row) {
  const float dx = vertex.x - x, dy = vertex.y - y, dz = vertex.z - z;
  if (!(dx * dx + dy * dy + dz * dz < reach_squared)) return false;
  const float px = T.s0 * x + T.s1 * y + T.s2 * z + T.s3;
  const float py = T.s4 * x + T.s5 * y + T.s6 * z + T.s7;
  const float pz = T.s8 * x + T.s9 * y + T.sa * z + T.sb;
  if (!(pz > 0.0f)) return false;
  const float u = K.x * px / pz + K.z + 0.5f;
  const float v = K.y * py / pz + K.w + 0.5f;
  return u >= column && u < column + 1.0f && v >= row && v < row + 1.0f;
}

// Voxels that have been found to take a label, until there are so many of them; so the memory is waited for once.
#define MOST_WAITING 32
typedef struct {
  int count;
  int slots[MOST_WAITING];
  int places[MOST_WAITING];  /* of the voxel in `labels` */
  uint labels[MOST_WAITING]; /* with LABEL_AT_ONCE */
} WaitingVoxels;

inline void change_waiting(WaitingVoxels* waiting, const int use_confidence, const int stamp, global uint* labels,
                           volatile global int* fragment_voxels, volatile global int* stamps,
                           volatile global int* count, global int* touched) {
  uint before[MOST_WAITING];
  for (int i = 0; i < waiting->count; ++i) before[i] = labels[waiting->places[i]];
  for (int i = 0; i < waiting->count; ++i) {
    const uint after = changed_voxel(before[i], waiting->labels[i], use_confidence);
    labels[waiting->places[i]] = after;
    if (LABEL_OF(before[i]) != LABEL_OF(after)) {
      if (LABEL_OF(before[i]) != 0u) atomic_dec(fragment_voxels + LABEL_OF(before[i]));
      atomic_inc(fragment_voxels + LABEL_OF(after));
    }
    const int slot = waiting->slots[i];
    if (stamps[slot] != stamp && atomic_xchg(stamps + slot, stamp) != stamp) touched[atomic_inc(count)] = slot;
  }
  waiting->count = 0;
}

kernel void update_labels(global const float4* vertices, global const uint* new_labels,
                          global const BrickEntry* table, const uint mask, const float16 T_camera_world,
                          const float4 K, const int width, const int height, const float voxel_size,
                          const float reach, const int use_confidence, const int stamp, global uint* labels,
                          volatile global int* fragment_voxels, volatile global int* stamps,
                          volatile global int* count, global int* touched) {
  const float16 T = T_camera_world;
  const float per_metre = 1.0f / voxel_size;
  const float around = reach * per_metre + 1e-3f; /* voxels; a little more against rounding */
  const int first = LANES * (int)get_global_id(0);
  const int end = min(first + LANES, width * height);
  KnownBrick known = no_brick_known();
  WaitingVoxels waiting;
  waiting.count = 0;
  for (int pixel = first; pixel < end; ++pixel) {
    const float4 vertex = vertices[pixel];
    const uint label = new_labels[pixel];
    if (!(vertex.w > 0.0f) || label == 0u) continue;
    const float column = (float)(pixel % width);
    const float row = (float)(pixel / width);

    // Voxels whose centres may lie within reach, along each axis: two or three of them for a reach of one voxel.
    const float3 at = vertex.xyz * per_metre - 0.5f;
    const int x0 = (int)ceil(at.x - around), x1 = (int)floor(at.x + around);
    const int y0 = (int)ceil(at.y - around), y1 = (int)floor(at.y + around);
    const int z0 = (int)ceil(at.z - around), z1 = (int)floor(at.z + around);
    // Most of them are seen in other pixels. How far to the right of the pixel's centre, and below it, a voxel is seen, times
    // its depth, and that depth are linear in x, y, z: what is clearly elsewhere is told by sums.
    const float3 start = transform_point(T, ((float3)((float)x0, (float)y0, (float)z0) + 0.5f) * voxel_size);
    const float a = K.z - column, b = K.w - row;
    const float3 right_by = (K.x * T.s012 + a * T.s89a) * voxel_size;
    const float3 below_by = (K.y * T.s456 + b * T.s89a) * voxel_size;
    const float3 off_by = T.s89a * (SURELY_OFF * voxel_size);
    float right_z = K.x * start.x + a * start.z, below_z = K.y * start.y + b * start.z, off_z = SURELY_OFF * start.z;
    for (int z = z0; z <= z1; ++z) {
      float right_y = right_z, below_y = below_z, off_y = off_z;
      for (int y = y0; y <= y1; ++y) {
        float right = right_y, below = below_y, off = off_y;
        for (int x = x0; x <= x1; ++x) {
          const bool may_be = fabs(right) <= off && fabs(below) <= off;
          right += right_by.x;
          below += below_by.x;
          off += off_by.x;
          if (!may_be) continue;
          if (!is_of_pixel(((float)x + 0.5f) * voxel_size, ((float)y + 0.5f) * voxel_size,
                           ((float)z + 0.5f) * voxel_size, vertex, reach * reach, T, K, column, row)) {
            continue;
          }
          const int slot = find_near(&known, table, mask, x >> BRICK_SHIFT, y >> BRICK_SHIFT, z >> BRICK_SHIFT);
          if (slot == BRICK_NONE) continue;
          waiting.slots[waiting.count] = slot;
          waiting.places[waiting.count] = slot * BRICK_VOXELS + (x & 7) + 8 * ((y & 7) + 8 * (z & 7));
          waiting.labels[waiting.count] = label;
          if (++waiting.count == MOST_WAITING)
            change_waiting(&waiting, use_confidence, stamp, labels, fragment_voxels, stamps, count, touched);
        }
        right_y += right_by.y;
        below_y += below_by.y;
        off_y += off_by.y;
      }
      right_z += right_by.z;
      below_z += below_by.z;
      off_z += off_by.z;
    }
  }
  change_waiting(&waiting, use_confidence, stamp, labels, fragment_voxels, stamps, count, touched);
}
