// Vertex and normal map of a depth plane, camera frame:
//   V(u, v) = ((u - cx) z / fx, (v - cy) z / fy, z, 1),  N = dV/dv x dV/du, normalised: towards the camera.
// A derivative is the central difference; where one neighbour has no reading or lies across a depth jump, the one-sided
// difference; where both do, there is no normal. All 0 where there is no value.
// One work-item: one pixel. plane: depth plane; vertices, normals: width * height, row by row.
#include "core/compute/kernels/common.clh"
#include "core/fusion/kernels/depth_plane.clh"

kernel void build_surface(global const float* restrict plane, const int width, const int height, const int stride,
                          const float4 K, global float4* restrict vertices, global float4* restrict normals) {
  const int u = (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  if (u >= width || v >= height) return;
  const int index = plane_index(stride, u, v);
  const float z = plane[index];
  const float right = plane[index + 1];
  const float left = plane[index - 1];
  const float below = plane[index + stride];
  const float above = plane[index - stride];

  const float jump = DEPTH_JUMP(z);
  const bool has_right = right > 0.0f && fabs(right - z) < jump;
  const bool has_left = left > 0.0f && fabs(left - z) < jump;
  const bool has_below = below > 0.0f && fabs(below - z) < jump;
  const bool has_above = above > 0.0f && fabs(above - z) < jump;

  const float x_factor = ((float)u - K.z) / K.x;
  const float y_factor = ((float)v - K.w) / K.y;
  // Differences over `step` pixels; the centre stands in for a missing neighbour.
  const float z_right = has_right ? right : z;
  const float z_left = has_left ? left : z;
  const float step_u = (has_right ? 1.0f : 0.0f) + (has_left ? 1.0f : 0.0f);
  const float z_below = has_below ? below : z;
  const float z_above = has_above ? above : z;
  const float step_v = (has_below ? 1.0f : 0.0f) + (has_above ? 1.0f : 0.0f);

  // d/du of (x_factor z, y_factor z, z), with x_factor changing by 1/fx per pixel.
  const float dz_u = z_right - z_left;
  const float dx_u = x_factor * dz_u + ((has_right ? z_right : 0.0f) + (has_left ? z_left : 0.0f)) / K.x;
  const float dy_u = y_factor * dz_u;
  const float dz_v = z_below - z_above;
  const float dx_v = x_factor * dz_v;
  const float dy_v = y_factor * dz_v + ((has_below ? z_below : 0.0f) + (has_above ? z_above : 0.0f)) / K.y;

  const float nx = dy_v * dz_u - dz_v * dy_u;
  const float ny = dz_v * dx_u - dx_v * dz_u;
  const float nz = dx_v * dy_u - dy_v * dx_u;
  const float length2 = nx * nx + ny * ny + nz * nz;
  const bool has_vertex = z > 0.0f;
  const bool has_normal = has_vertex && step_u > 0.0f && step_v > 0.0f && length2 > 0.0f;
  const float scale = has_normal ? rsqrt(length2) : 0.0f;
  const int out = v * width + u;
  vertices[out] = (float4)(x_factor * z, y_factor * z, z, has_vertex ? 1.0f : 0.0f);
  normals[out] = has_normal ? (float4)(nx * scale, ny * scale, nz * scale, 1.0f) : (float4)(0.0f);
}
