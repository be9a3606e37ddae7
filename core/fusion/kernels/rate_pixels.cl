// Rates how well a colour image shows the surface, per cell of COLOR_CELL * COLOR_CELL pixels of the depth camera. The first pixel
// represents its cell, with vertex V, normal n and z along the depth camera's axis:
//   weight = COLOR_WEIGHT_ONE cos / |e|^2, cos = n . e / |e|, e from V to the colour camera; an integer from 1 to
//            COLOR_WEIGHT_OF_VIEW_MAX.
//   reach  = (across + slack sin_d) / cos_d: distance along z from V within which pixels of the cell show this surface, that is
//            `across` from the tangent plane; cos_d as cos for the depth camera, slack = CELL_REACH pixels (longer sides) at V.
// The depth is 0 (no colour) if
//   there is no surface, it is hidden from the colour camera, or either camera sees it at less than MIN_COS;
//   the frame has no reading or one off the surface, because an object in front has another colour;
//   a reading at EDGE_LOW or EDGE_HIGH pixels in eight directions is hidden or off the tangent plane: at an outline, colour and
//   depth are never exactly aligned. A missing reading counts as a hole in the surface only if the map has surface at twice
//   that distance in pixels.
// Depths agree within apart.x + apart.y z^2.
//
// One work-item: one cell. vertices, normals: world, width * height, w = 0: none. readings: camera, likewise. hidden: width *
// height, not 0 = hidden. eye, color_eye: the cameras in the world. depths, ratings (reach and weight, COLOR_RATING): one per cell,
// row by row.
#include "core/compute/kernels/common.clh"
#include "core/fusion/kernels/color_voxel.h"

#define MIN_COS 0.15f
#define EDGE_LOW 2
#define EDGE_HIGH 3
#define CELL_REACH 1.5f

kernel void rate_pixels(global const float4* restrict vertices, global const float4* restrict normals,
                        global const float4* restrict readings, global const uchar* restrict hidden, const int width,
                        const int height, const float16 T_camera_world, const float4 eye, const float4 color_eye,
                        const float pixels_per_ray, const float across, const float2 apart,
                        global float* restrict depths, global uint* restrict ratings) {
  const int column = (int)get_global_id(0);
  const int row = (int)get_global_id(1);
  const int columns = (width + COLOR_CELL - 1) / COLOR_CELL;
  if (column >= columns || row >= (height + COLOR_CELL - 1) / COLOR_CELL) return;
  const int cell = row * columns + column;
  depths[cell] = 0.0f;
  ratings[cell] = 0u;
  const int u = COLOR_CELL * column;
  const int v = COLOR_CELL * row;
  const int pixel = v * width + u;
  const float4 vertex = vertices[pixel];
  const float4 normal = normals[pixel];
  const float4 reading = readings[pixel];
  if (!(vertex.w > 0.0f) || !(normal.w > 0.0f) || !(reading.w > 0.0f) || hidden[pixel] != 0) return;

  const float z = transform_point(T_camera_world, vertex.xyz).z;
  const float most = apart.x + apart.y * z * z;
  if (!(fabs(reading.z - z) <= most)) return;
  const float3 towards = eye.xyz - vertex.xyz;
  const float cosine = dot(normal.xyz, towards) / length(towards);
  const float3 towards_color = color_eye.xyz - vertex.xyz;
  const float square = dot(towards_color, towards_color);
  const float color_cosine = dot(normal.xyz, towards_color) / sqrt(square);
  if (!(cosine >= MIN_COS) || !(color_cosine >= MIN_COS)) return;

  const float3 n = rotate_vector(T_camera_world, normal.xyz);
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const int x = u + (i < 0 ? -EDGE_LOW : i * EDGE_HIGH);
      const int y = v + (j < 0 ? -EDGE_LOW : j * EDGE_HIGH);
      if (x < 0 || y < 0 || x >= width || y >= height) continue;
      const int other = y * width + x;
      if (hidden[other] != 0) return;
      float4 beside = readings[other];
      if (!(beside.w > 0.0f)) {
        const int far_x = 2 * x - u;
        const int far_y = 2 * y - v;
        if (far_x < 0 || far_y < 0 || far_x >= width || far_y >= height) return;
        beside = vertices[far_y * width + far_x];
        if (!(beside.w > 0.0f)) return;
        beside.xyz = transform_point(T_camera_world, beside.xyz);
      }
      if (!(fabs(dot(n, beside.xyz - reading.xyz)) <= most)) return;
    }
  }
  const float sine = sqrt(fmax(0.0f, 1.0f - cosine * cosine));
  depths[cell] = z;
  const float reach = (across + CELL_REACH * z / pixels_per_ray * sine) / cosine;
  const float weight = clamp(rint(COLOR_WEIGHT_ONE * color_cosine / square), 1.0f, COLOR_WEIGHT_OF_VIEW_MAX);
  ratings[cell] = COLOR_RATING((uint)min(reach / COLOR_REACH_STEP_M, COLOR_REACH_STEPS_MAX), (uint)weight);
}
