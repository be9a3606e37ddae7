// Label cloud update (thesis, Algorithms 1 and 2), turned inside out. The algorithm visits every voxel of space:
//   v_g = (voxel + 0.5) * voxel_size, seen in pixel u = floor(K (T_camera_world v_g) + 0.5) with depth > 0;
//   where |V_t(u) - v_g| < reach and S_cloud,t(u) != 0 the voxel takes S_cloud,t(u).
// A voxel is seen in one pixel at most, and only voxels within reach of that pixel's vertex are written: so visit those from
// the pixel, and write those that are seen in it. The result is the same, and no voxel is written twice.
// With confidence: a voxel that holds the same fragment gains one (up to the cap), one of another loses one and
// changes at zero, or at once where LABEL_AT_ONCE says so; without: it is overwritten.
// A voxel whose brick does not exist is told of and left for another run, with only_new: once its brick has been made, it
// alone takes its label then.
// One work-item: LANES pixels.
//   vertices         pixels x float4, world, w = 0: no surface
//   cells, page_slots, window_size  the view's window (brick_page.h); first: the brick at which it starts. Bricks in it are found fast
//   new_labels       pixels, S_cloud,t as fragments, with LABEL_AT_ONCE
//   labels           slots x 512 label voxels, in/out
//   fragment_voxels  voxels that hold each fragment, in/out
//   stamps           slots, in/out: number of the run in which the slot was last listed, so that it is listed once;
//                    LABEL_BRICK_NEW: not in any
//   touched          out: slots in which a voxel was visited, counts[0] of them
//   missing          capacity x int4, out: bricks that do not exist, with repetitions; counts[1] of them, those beyond the
//                    capacity are not stored
#include "core/compute/kernels/lanes.clh"
#include "core/fusion/kernels/brick_lookup.clh"
#include "core/fusion/kernels/brick_window.clh"
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
                           volatile global int* counts, global int* touched) {
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
    if (stamps[slot] != stamp && atomic_xchg(stamps + slot, stamp) != stamp) touched[atomic_inc(counts)] = slot;
  }
  waiting->count = 0;
}

#define X_AT(vertices, i) (vertices)[i].x
#define Y_AT(vertices, i) (vertices)[i].y
#define Z_AT(vertices, i) (vertices)[i].z
#define W_AT(vertices, i) (vertices)[i].w

// Voxel n of a cube of side^3; per_side = 65536 / side + 1: divisions take long. Right for sides up to 12.
inline int3 voxel_in_cube(const int n, const int side, const int per_side) {
  const int row = (n * per_side) >> 16;
  const int slice = (row * per_side) >> 16;
  return (int3)(n - row * side, row - slice * side, slice);
}

// What the lanes' pixels have to be asked for one by one.
typedef struct {
  int x0[LANES], y0[LANES], z0[LANES]; /* the first voxel of the cube around the vertex */
  int found[LANES];                    /* bit i: voxel from + i of the cube is the pixel's */
} Pixels;

kernel void update_labels(global const float4* vertices, global const uint* new_labels,
                          global const int* cells, global const int* page_slots, const int4 window_size,
                          const int4 first, global const BrickEntry* table, const uint mask,
                          const float16 T_camera_world,
                          const float4 K, const int width, const int height, const float voxel_size,
                          const float reach, const int use_confidence, const int stamp, const int only_new,
                          global uint* labels, volatile global int* fragment_voxels, volatile global int* stamps,
                          volatile global int* counts, global int* touched, global int4* missing,
                          const int capacity) {
  const float16 T = T_camera_world;
  const float per_metre = 1.0f / voxel_size;
  const float around = reach * per_metre + 1e-3f; /* voxels; a little more against rounding */
  const int begin = LANES * (int)get_global_id(0);
  const int last = width * height - 1;
  const intN pixel = min(begin + LANE, (intN)last);
  const uintN label = GATHER(uintN, new_labels, pixel);
  const floatN vertex_x = EACH_LANE(floatN, X_AT, vertices, pixel);
  const floatN vertex_y = EACH_LANE(floatN, Y_AT, vertices, pixel);
  const floatN vertex_z = EACH_LANE(floatN, Z_AT, vertices, pixel);
  const floatN vertex_w = EACH_LANE(floatN, W_AT, vertices, pixel);
  const intN active = (begin + LANE <= last) & (vertex_w > 0.0f) & (label != 0u);
  if (!any_lane(active)) return;
  const intN row = pixel / width;
  const intN column = pixel - row * width;

  // Voxels whose centres may lie within reach, along each axis: two or three of them for a reach of one voxel.
  const int side = (int)floor(2.0f * around) + 1;
  const int per_side = 65536 / side + 1;
  const floatN x0 = ceil(vertex_x * per_metre - 0.5f - around);
  const floatN y0 = ceil(vertex_y * per_metre - 0.5f - around);
  const floatN z0 = ceil(vertex_z * per_metre - 0.5f - around);
  const floatN left = convert_floatN(column), top = convert_floatN(row);

  Pixels pixels;
  STORE(convert_intN(x0), pixels.x0);
  STORE(convert_intN(y0), pixels.y0);
  STORE(convert_intN(z0), pixels.z0);
  KnownBrick known = no_brick_known();
  WaitingVoxels waiting;
  waiting.count = 0;
  const int voxels = side * side * side;
  for (int from = 0; from < voxels; from += 32) {
    intN found = 0;
    for (int i = 0; i < 32 && from + i < voxels; ++i) {
      const int3 n = voxel_in_cube(from + i, side, per_side);
      const floatN x = (x0 + (float)n.x + 0.5f) * voxel_size;
      const floatN y = (y0 + (float)n.y + 0.5f) * voxel_size;
      const floatN z = (z0 + (float)n.z + 0.5f) * voxel_size;
      const floatN dx = vertex_x - x, dy = vertex_y - y, dz = vertex_z - z;
      const intN near = active & (dx * dx + dy * dy + dz * dz < reach * reach);
      if (!any_lane(near)) continue;
      const floatN depth = T.s8 * x + T.s9 * y + T.sa * z + T.sb;
      const floatN u = K.x * (T.s0 * x + T.s1 * y + T.s2 * z + T.s3) / depth + K.z + 0.5f;
      const floatN v = K.y * (T.s4 * x + T.s5 * y + T.s6 * z + T.s7) / depth + K.w + 0.5f;
      const intN seen = near & (depth > 0.0f) & (u >= left) & (u < left + 1.0f) & (v >= top) & (v < top + 1.0f);
      found |= seen ? (intN)(1 << i) : (intN)0;
    }
    STORE(found, pixels.found);
    for (int lane = 0; lane < LANES; ++lane) {
      for (uint bits = (uint)pixels.found[lane]; bits != 0u; bits &= bits - 1u) {
        const int3 n = voxel_in_cube(from + 31 - (int)clz(bits & -bits), side, per_side);
        const int vx = pixels.x0[lane] + n.x, vy = pixels.y0[lane] + n.y, vz = pixels.z0[lane] + n.z;
        const int bx = vx >> BRICK_SHIFT, by = vy >> BRICK_SHIFT, bz = vz >> BRICK_SHIFT;
        const bool is_known = known.x == bx && known.y == by && known.z == bz;
        if (!is_known) {
          const int in_window = window_slot(cells, page_slots, window_size, bx - first.x, by - first.y,
                                            bz - first.z);
          known.x = bx;
          known.y = by;
          known.z = bz;
          known.slot = in_window >= 0 ? in_window : find_brick(table, mask, bx, by, bz);
        }
        const int slot = known.slot;
        if (slot == BRICK_NONE) {
          if (is_known) continue;
          const int place = atomic_inc(counts + 1);
          if (place < capacity) missing[place] = (int4)(bx, by, bz, 0);
          continue;
        }
        if (only_new && stamps[slot] != LABEL_BRICK_NEW && stamps[slot] != stamp) continue;
        waiting.slots[waiting.count] = slot;
        waiting.places[waiting.count] = slot * BRICK_VOXELS + (vx & 7) + 8 * ((vy & 7) + 8 * (vz & 7));
        waiting.labels[waiting.count] = new_labels[begin + lane];
        if (++waiting.count == MOST_WAITING)
          change_waiting(&waiting, use_confidence, stamp, labels, fragment_voxels, stamps, counts, touched);
      }
    }
  }
  change_waiting(&waiting, use_confidence, stamp, labels, fragment_voxels, stamps, counts, touched);
}
