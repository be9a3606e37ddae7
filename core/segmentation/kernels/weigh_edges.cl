#include "core/segmentation/kernels/edge_layout.h"

// Weights of the pixel graph of V_t, N_t, thesis eq. 3.5, as sortable keys (edge_layout.h):
//
//     w_ij = MAXWGHT            if |v_i - v_j| >= d_max
//            (1 - n_i . n_j)^2  if closer and (v_j - v_i) . n_j > 0   (convex)
//            1 - n_i . n_j      otherwise                             (concave)
//
// with unit normals towards the camera, j the forward neighbour of i, and d_max = max(distance_factor *
// min(z_i, z_j) / f, min_distance). 1 - n_i . n_j is computed as |n_i - n_j|^2 / 2, which for unit vectors
// is the same and keeps its precision near 0.
//
// One work-item: LANES pixels i in a row and their forward edges. vertices, normals: width * height float4, w = 0 or
// a value that is not finite: missing pixel. depth_row: the row of T_camera_world that gives z. keys: width *
// height ushort4 in the order of the directions; edges out of the image or to a missing pixel are
// EDGE_NEVER. depths: z in metres where vertex and normal exist, else 0.
#include "core/compute/kernels/lanes.clh"

typedef struct Surface {
  Points v, n;
  floatN z;
  intN exists;
} Surface;

inline Points less(const Points a, const Points b) {
  const Points difference = {a.x - b.x, a.y - b.y, a.z - b.z, 0.0f};
  return difference;
}

inline Surface surface_at(global const float4* vertices, global const float4* normals, const intN i,
                          const float4 depth_row) {
  Surface s;
  s.v = points_at(vertices, i);
  s.n = points_at(normals, i);
  s.z = depth_row.x * s.v.x + depth_row.y * s.v.y + depth_row.z * s.v.z + depth_row.w;
  const floatN length2 = dot_of(s.n, s.n);
  s.exists = (s.v.w > 0.0f) & (s.n.w > 0.0f) & (dot_of(s.v, s.v) < 1e12f) & (length2 > 0.5f) & (length2 < 2.0f) &
             (s.z > 0.0f);
  return s;
}

inline uintN key_of(const floatN weight) {
  const floatN w = weight > EDGE_WEIGHT_FLOOR ? weight : (floatN)(EDGE_WEIGHT_FLOOR);
  return (as_uintN(w) - EDGE_WEIGHT_FLOOR_BITS) >> EDGE_KEY_SHIFT;
}

inline uintN edge_key(const Surface* i, const Surface j, const intN may_join, const float distance_factor_per_f,
                      const float min_distance) {
  const Points step = less(j.v, i->v);
  const floatN nearer = distance_factor_per_f * (i->z < j.z ? i->z : j.z);
  const floatN max_distance = nearer > min_distance ? nearer : (floatN)(min_distance);
  const Points turn = less(i->n, j.n);
  const floatN concave = 0.5f * dot_of(turn, turn);
  const floatN weight = dot_of(step, j.n) > 0.0f ? concave * concave : concave;
  const intN joins = may_join & i->exists & j.exists & where(dot_of(step, step) < max_distance * max_distance);
  return joins ? key_of(joins ? (weight < 4.0f ? weight : (floatN)(4.0f)) : (floatN)(1.0f)) : (uintN)(EDGE_NEVER);
}

kernel void weigh_edges(global const float4* vertices, global const float4* normals, global ushort4* keys,
                        global float* depths, const int width, const int height, const int neighbours,
                        const float4 depth_row, const float distance_factor_per_f, const float min_distance) {
  const int x = LANES * (int)get_global_id(0);
  const int y = (int)get_global_id(1);
  if (x >= width || y >= height) return;
  const int begin = y * width + x;
  const intN last = width * height - 1;
  const intN column = x + LANE;
  const intN i = min(begin + LANE, last);
  const intN in_row = column < width;
  const intN east = column < width - 1;
  const intN west = in_row & where(column > 0);
  const Surface here = surface_at(vertices, normals, i, depth_row);
#define KEY_TO(offset, may_join)                                                                                     \
  edge_key(&here, surface_at(vertices, normals, min(i + (offset), last), depth_row), may_join, distance_factor_per_f, \
           min_distance)
  const uintN never = EDGE_NEVER;
  const uintN to_east = KEY_TO(1, east);
  uintN to_south = never, to_south_east = never, to_south_west = never;
  if (y + 1 < height) {
    to_south = KEY_TO(width, in_row);
    if (neighbours == 8) {
      to_south_east = KEY_TO(width + 1, east);
      to_south_west = KEY_TO(width - 1, west);
    }
  }
  const ulongN four = convert_ulongN(to_east | (to_south << 16)) | (convert_ulongN(to_south_east | (to_south_west << 16)) << 32);
  STORE_FIRST(ulong, four, (global ulong*)keys + begin, width - x);
  const floatN z = here.exists ? here.z : 0.0f;
  STORE_FIRST(float, z, depths + begin, width - x);
}
