// Label cloud update (thesis, Algorithms 1 and 2), pixel by pixel. The algorithm visits every voxel of space:
//   v_g = (voxel + 0.5) * voxel_size projects to pixel u = floor(K (T_camera_world v_g) + 0.5) with depth > 0;
//   if |V_t(u) - v_g| < reach(u) and S_cloud,t(u) != 0, the voxel takes S_cloud,t(u).
// reach(u) is the larger of `reach` and reach_of_depth times the depth of V_t(u): half the diagonal of what a pixel of the
// camera covers, so that no voxel between two pixels keeps another label. At most MAX_REACH_VOX voxels.
// A voxel is seen in at most one pixel, and only voxels within reach of that pixel's vertex are written. So each pixel visits the
// voxels around its vertex and writes those seen in it. The result is the same, and no voxel is written twice.
// With confidence: a voxel of the same fragment gains one (up to the cap); one of another fragment loses one and changes at
// zero, or at once with LABEL_AT_ONCE. Without: it is overwritten.
// Voxels of missing bricks, which no depth has reached, are left out: labels never change the surface.
// One work-item: LANES of the listed pixels.
//   vertices         pixels of the view x float4, world, w = 0: no surface
//   cells, page_slots, window_size  the view's window (brick_page.h); first: the brick at which it starts. Bricks
//                    outside are found by a slower lookup
//   pixels           count pixels that write; new_labels: their S_cloud,t as fragments (not 0), with LABEL_AT_ONCE
//   labels           slots x 512 label voxels, in/out
//   fragment_voxels  voxels that hold each fragment, in/out
//   stamps           slots, in/out: number of the run in which the slot was last listed, so that it is listed once;
//                    LABEL_BRICK_UNUSED: in none
//   touched          out: slots in which a voxel was visited, *touched_count of them
#include "core/fusion/kernels/brick_field.clh"
#include "core/fusion/kernels/brick_lookup.clh"
#include "core/labeling/kernels/label_voxel.h"

inline uintN changed_voxels(const uintN voxel, const uintN new_label, const int use_confidence) {
  const uintN label = new_label & LABEL_MAX;
  const uintN fresh = LABEL_VOXEL(label, 1u);
  if (!use_confidence) return fresh;
  const uintN held = LABEL_OF(voxel);
  const uintN confidence = CONFIDENCE_OF(voxel);
  const uintN surer = LABEL_VOXEL(held, min(confidence + 1u, (uintN)(LABEL_CONFIDENCE_MAX)));
  const intN gives_way = where(held == 0u) | where(confidence <= 1u) | where((new_label & LABEL_AT_ONCE) != 0u);
  const uintN less_sure = gives_way ? fresh : LABEL_VOXEL(held, confidence - 1u);
  return held == label ? surer : less_sure;
}

// Voxels that wait for a label, for lookup of LANES at a time.
#define MOST_WAITING 64
typedef struct {
  int count;
  int x[MOST_WAITING], y[MOST_WAITING], z[MOST_WAITING]; /* world coordinates */
  uint labels[MOST_WAITING];                             /* with LABEL_AT_ONCE */
} WaitingVoxels;

// The labels, and the lists of changes.
typedef struct {
  Field field;
  int4 first;
  global const BrickEntry* table;
  uint mask;
  global uint* labels;
  volatile global int* fragment_voxels;
  volatile global int* stamps;
  volatile global int* touched_count;
  global int* touched;
  int stamp;
} Cloud;

// The slots of voxels in lanes beyond the window, if their bricks exist.
inline void find_beyond_window(const Cloud* cloud, const WaitingVoxels* waiting, const int from, int* slots) {
  KnownBrick known = no_brick_known();
  for (int lane = 0; lane < min(LANES, waiting->count - from); ++lane) {
    if (slots[lane] >= 0) continue;
    const int x = waiting->x[from + lane] >> BRICK_SHIFT, y = waiting->y[from + lane] >> BRICK_SHIFT,
              z = waiting->z[from + lane] >> BRICK_SHIFT;
    if (known.x != x || known.y != y || known.z != z) {
      known.x = x;
      known.y = y;
      known.z = z;
      known.slot = find_brick(cloud->table, cloud->mask, x, y, z);
    }
    slots[lane] = known.slot;
  }
}

// The labels and pool indices of the lanes' voxels.
typedef struct {
  intN active, slot, place, stamped;
  uintN before;
} Held;

inline Held look_up(const Cloud* cloud, const WaitingVoxels* waiting, const int from) {
  const intN x = LOAD(waiting->x + from) - BRICK_SIDE * cloud->first.x;
  const intN y = LOAD(waiting->y + from) - BRICK_SIDE * cloud->first.y;
  const intN z = LOAD(waiting->z + from) - BRICK_SIDE * cloud->first.z;
  const intN exists = from + LANE < waiting->count;
  intN slot = field_slot(&cloud->field, field_page(&cloud->field, x, y, z), x, y, z);
  if (any_lane(exists & where(slot < 0))) {
    int slots[LANES];
    STORE(slot, slots);
    find_beyond_window(cloud, waiting, from, slots);
    slot = LOAD(slots);
  }
  Held held;
  held.active = exists & (slot >= 0);
  held.slot = held.active ? slot : 0;
  held.stamped = GATHER(intN, cloud->stamps, held.slot);
  const intN unused = held.active & where(held.stamped < 0);
  if (any_lane(unused)) {
    int slots[LANES], is_unused[LANES];
    STORE(held.slot, slots);
    STORE(unused, is_unused);
    for (int lane = 0; lane < LANES; ++lane)
      if (is_unused[lane]) write_before_read(cloud->labels + slots[lane] * BRICK_VOXELS);
  }
  held.place = held.active ? held.slot * BRICK_VOXELS + (x & 7) + 8 * (y & 7) + 64 * (z & 7) : 0;
  held.before = GATHER(uintN, cloud->labels, held.place);
  return held;
}

inline void change(const Cloud* cloud, const Held* held, const uintN label, const int use_confidence) {
  const uintN after = changed_voxels(held->before, label, use_confidence);
  const intN changed = held->active & where(held->before != after);
  const intN first_here = held->active & where(held->stamped != cloud->stamp);
  if (!any_lane(changed | first_here)) return;
  int is_changed[LANES], is_first[LANES], places[LANES], slots[LANES];
  uint old[LANES], fresh[LANES];
  STORE(changed, is_changed);
  STORE(first_here, is_first);
  STORE(held->place, places);
  STORE(held->slot, slots);
  STORE(held->before, old);
  STORE(after, fresh);
  for (int lane = 0; lane < LANES; ++lane) {
    if (is_changed[lane]) {
      cloud->labels[places[lane]] = fresh[lane];
      if (LABEL_OF(old[lane]) != LABEL_OF(fresh[lane])) {
        if (LABEL_OF(old[lane]) != 0u) atomic_dec(cloud->fragment_voxels + LABEL_OF(old[lane]));
        atomic_inc(cloud->fragment_voxels + LABEL_OF(fresh[lane]));
      }
    }
    if (is_first[lane] && atomic_xchg(cloud->stamps + slots[lane], cloud->stamp) != cloud->stamp)
      cloud->touched[atomic_inc(cloud->touched_count)] = slots[lane];
  }
}

// Reads all voxels before writing any, so that the kernel waits for memory once.
inline void change_waiting(const Cloud* cloud, WaitingVoxels* waiting, const int use_confidence) {
  Held held[MOST_WAITING / LANES];
#pragma unroll
  for (int i = 0; i < MOST_WAITING / LANES; ++i)
    if (LANES * i < waiting->count) held[i] = look_up(cloud, waiting, LANES * i);
#pragma unroll
  for (int i = 0; i < MOST_WAITING / LANES; ++i)
    if (LANES * i < waiting->count) change(cloud, &held[i], LOAD(waiting->labels + LANES * i), use_confidence);
  waiting->count = 0;
}

// sides up to 12 (voxel_in_cube())
#define MAX_REACH_VOX 5.0f

// Voxel n of a cube of side^3; per_side = 65536 / side + 1 replaces a slow division. Exact for sides up to 12.
inline int3 voxel_in_cube(const int n, const int side, const int per_side) {
  const int row = (n * per_side) >> 16;
  const int slice = (row * per_side) >> 16;
  return (int3)(n - row * side, row - slice * side, slice);
}

// Values of the lanes' pixels for scalar access.
typedef struct {
  int x0[LANES], y0[LANES], z0[LANES]; /* the first voxel of the cube around the vertex */
  int found[LANES];                    /* bit i: voxel from + i of the cube projects to the pixel */
  uint labels[LANES];
} Pixels;

kernel void update_labels(global const float4* vertices, global const int* pixels, global const uint* new_labels,
                          const int count, global const int* cells, global const int* page_slots, const int4 window_size,
                          const int4 first, global const BrickEntry* table, const uint mask,
                          const float16 T_camera_world,
                          const float4 K, const int width, const float voxel_size,
                          const float reach, const float reach_of_depth, const int use_confidence, const int stamp,
                          global uint* labels, volatile global int* fragment_voxels, volatile global int* stamps,
                          volatile global int* touched_count, global int* touched) {
  const float16 T = T_camera_world;
  const float per_metre = 1.0f / voxel_size;
  const int begin = LANES * (int)get_global_id(0);
  if (begin >= count) return;
  const intN listed = min(begin + LANE, (intN)(count - 1));
  const intN pixel = GATHER(intN, pixels, listed);
  const uintN label = GATHER(uintN, new_labels, listed);
  const Points vertex = points_at(vertices, pixel);
  const intN active = where(begin + LANE < count) & where(vertex.w > 0.0f);
  if (!any_lane(active)) return;
  const intN row = pixel / width;
  const intN column = pixel - row * width;

  const floatN depth_m = T.s8 * vertex.x + T.s9 * vertex.y + T.sa * vertex.z + T.sb;
  const floatN reach_here = min(max((floatN)(reach), reach_of_depth * depth_m), (floatN)(max(reach, MAX_REACH_VOX * voxel_size)));
  float reaches[LANES], longest = reach;
  STORE(active ? reach_here : (floatN)(reach), reaches);
  for (int lane = 0; lane < LANES; ++lane) longest = max(longest, reaches[lane]);
  const float around = longest * per_metre + 1e-3f; /* voxels; a little more against rounding */

  // Voxels whose centres may lie within reach, along each axis: two or three of them for a reach of one voxel.
  const int side = (int)floor(2.0f * around) + 1;
  const int per_side = 65536 / side + 1;
  const floatN x0 = ceil(vertex.x * per_metre - 0.5f - around);
  const floatN y0 = ceil(vertex.y * per_metre - 0.5f - around);
  const floatN z0 = ceil(vertex.z * per_metre - 0.5f - around);
  const floatN left = convert_floatN(column), top = convert_floatN(row);

  Pixels asked;
  STORE(convert_intN(x0), asked.x0);
  STORE(convert_intN(y0), asked.y0);
  STORE(convert_intN(z0), asked.z0);
  STORE(label, asked.labels);
  const Cloud cloud = {{cells, page_slots, 0, window_size}, first, table, mask, labels, fragment_voxels, stamps,
                       touched_count, touched, stamp};
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
      const floatN dx = vertex.x - x, dy = vertex.y - y, dz = vertex.z - z;
      const intN near = active & where(dx * dx + dy * dy + dz * dz < reach_here * reach_here);
      if (!any_lane(near)) continue;
      const floatN depth = T.s8 * x + T.s9 * y + T.sa * z + T.sb;
      const floatN u = K.x * (T.s0 * x + T.s1 * y + T.s2 * z + T.s3) / depth + K.z + 0.5f;
      const floatN v = K.y * (T.s4 * x + T.s5 * y + T.s6 * z + T.s7) / depth + K.w + 0.5f;
      const intN seen = near & where(depth > 0.0f) & where(u >= left) & where(u < left + 1.0f) & where(v >= top) & where(v < top + 1.0f);
      found |= seen ? (intN)(1 << i) : (intN)0;
    }
    STORE(found, asked.found);
    for (int lane = 0; lane < LANES; ++lane) {
      for (uint bits = (uint)asked.found[lane]; bits != 0u; bits &= bits - 1u) {
        const int3 n = voxel_in_cube(from + 31 - (int)clz(bits & -bits), side, per_side);
        waiting.x[waiting.count] = asked.x0[lane] + n.x;
        waiting.y[waiting.count] = asked.y0[lane] + n.y;
        waiting.z[waiting.count] = asked.z0[lane] + n.z;
        waiting.labels[waiting.count] = asked.labels[lane];
        if (++waiting.count == MOST_WAITING) change_waiting(&cloud, &waiting, use_confidence);
      }
    }
  }
  change_waiting(&cloud, &waiting, use_confidence);
}
