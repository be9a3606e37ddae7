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
// One work-item: one pixel i and its forward edges. vertices, normals: width * height float4, w = 0 or
// anything not finite: no such pixel. depth_row: the row of T_camera_world that gives z. keys: width *
// height ushort4 in the order of the directions; edges that leave the image or meet a missing pixel are
// EDGE_NEVER. depths: z in metres where vertex and normal exist, else 0.

inline bool is_point(const float4 v, const float4 n) {
  return v.w > 0.0f && n.w > 0.0f && dot(v.xyz, v.xyz) < 1e12f && dot(n.xyz, n.xyz) > 0.5f && dot(n.xyz, n.xyz) < 2.0f;
}

inline float depth_of(const float4 v, const float4 depth_row) {
  return dot(depth_row.xyz, v.xyz) + depth_row.w;
}

inline ushort key_of(const float weight) {
  return (ushort)((as_uint(fmax(weight, EDGE_WEIGHT_FLOOR)) - EDGE_WEIGHT_FLOOR_BITS) >> EDGE_KEY_SHIFT);
}

inline ushort edge_key(const float4 vi, const float4 ni, const float zi, const float4 vj, const float4 nj,
                       const float4 depth_row, const float distance_factor_per_f, const float min_distance) {
  const float3 step = vj.xyz - vi.xyz;
  const float zj = depth_of(vj, depth_row);
  const float max_distance = fmax(distance_factor_per_f * fmin(zi, zj), min_distance);
  const float3 turn = ni.xyz - nj.xyz;
  const float concave = 0.5f * dot(turn, turn);
  const float weight = dot(step, nj.xyz) > 0.0f ? concave * concave : concave;
  const bool joins = is_point(vj, nj) && zj > 0.0f && dot(step, step) < max_distance * max_distance;
  return joins ? key_of(fmin(weight, 4.0f)) : (ushort)EDGE_NEVER;
}

kernel void weigh_edges(global const float4* vertices, global const float4* normals, global ushort4* keys,
                        global float* depths, const int width, const int height, const int neighbours,
                        const float4 depth_row, const float distance_factor_per_f, const float min_distance) {
  const int x = get_global_id(0);
  const int y = get_global_id(1);
  if (x >= width || y >= height) return;
  const int i = y * width + x;
  const float4 v = vertices[i];
  const float4 n = normals[i];
  const float z = depth_of(v, depth_row);
  const bool here = is_point(v, n) && z > 0.0f;
  ushort4 result = (ushort4)(EDGE_NEVER);
  if (here) {
    const bool east = x + 1 < width;
    const bool south = y + 1 < height;
    if (east) {
      result.s0 = edge_key(v, n, z, vertices[i + 1], normals[i + 1], depth_row, distance_factor_per_f, min_distance);
    }
    if (south) {
      const int j = i + width;
      result.s1 = edge_key(v, n, z, vertices[j], normals[j], depth_row, distance_factor_per_f, min_distance);
    }
    if (neighbours == 8 && south && east) {
      const int j = i + width + 1;
      result.s2 = edge_key(v, n, z, vertices[j], normals[j], depth_row, distance_factor_per_f, min_distance);
    }
    if (neighbours == 8 && south && x > 0) {
      const int j = i + width - 1;
      result.s3 = edge_key(v, n, z, vertices[j], normals[j], depth_row, distance_factor_per_f, min_distance);
    }
  }
  keys[i] = result;
  depths[i] = here ? z : 0.0f;
}
