// Vertex and normal map of a depth plane, camera frame:
//   V(u, v) = ((u - cx) z / fx, (v - cy) z / fy, z, 1),  N = dV/dv x dV/du, normalised: towards the camera.
// A derivative is the central difference, or the one-sided difference if one neighbour has no reading or lies across a depth
// jump. If both do, there is no normal. Missing values are all 0.
// One work-item: LANES pixels in a row. plane: depth plane; vertices, normals: width * height, row by row.
#include "core/compute/kernels/lanes.clh"
#include "core/fusion/kernels/depth_plane.clh"

// The difference of the two neighbours of a pixel of depth z; z replaces a missing neighbour.
typedef struct Difference {
  floatN after, before; /* z of the neighbours, 0 if missing */
  floatN dz;
  intN exists;
} Difference;

inline Difference difference_of(const floatN before, const floatN z, const floatN after, const floatN jump) {
  const intN has_after = where(after > 0.0f) & where(fabs(after - z) < jump);
  const intN has_before = where(before > 0.0f) & where(fabs(before - z) < jump);
  const Difference d = {has_after ? after : 0.0f, has_before ? before : 0.0f,
                        (has_after ? after : z) - (has_before ? before : z), has_after | has_before};
  return d;
}

kernel void build_surface(global const float* restrict plane, const int width, const int height, const int stride,
                          const float4 K, global float4* restrict vertices, global float4* restrict normals) {
  const int u = LANES * (int)get_global_id(0);
  const int v = (int)get_global_id(1);
  if (u >= width || v >= height) return;
  global const float* at = plane + plane_index(stride, u, v);
  const floatN z = LOAD(at);
  const floatN jump = DEPTH_JUMP(z);
  const Difference across = difference_of(LOAD(at - 1), z, LOAD(at + 1), jump);
  const Difference down = difference_of(LOAD(at - stride), z, LOAD(at + stride), jump);

  // d/du of (x_factor z, y_factor z, z), with x_factor changing by 1/fx per pixel.
  const floatN x_factor = ((float)u + convert_floatN(LANE) - K.z) / K.x;
  const float y_factor = ((float)v - K.w) / K.y;
  const floatN dz_u = across.dz;
  const floatN dx_u = x_factor * dz_u + (across.after + across.before) / K.x;
  const floatN dy_u = y_factor * dz_u;
  const floatN dz_v = down.dz;
  const floatN dx_v = x_factor * dz_v;
  const floatN dy_v = y_factor * dz_v + (down.after + down.before) / K.y;

  const floatN nx = dy_v * dz_u - dz_v * dy_u;
  const floatN ny = dz_v * dx_u - dx_v * dz_u;
  const floatN nz = dx_v * dy_u - dy_v * dx_u;
  const floatN length2 = nx * nx + ny * ny + nz * nz;
  const intN has_vertex = z > 0.0f;
  const intN has_normal = has_vertex & across.exists & down.exists & where(length2 > 0.0f);
  const floatN scale = has_normal ? 1.0f / sqrt(length2) : 0.0f;
  const int out = v * width + u;
  const Points vertex = {x_factor * z, y_factor * z, z, one_where(has_vertex)};
  const Points normal = {nx * scale, ny * scale, nz * scale, one_where(has_normal)};
  store_points(vertex, vertices + out, width - u);
  store_points(normal, normals + out, width - u);
}
