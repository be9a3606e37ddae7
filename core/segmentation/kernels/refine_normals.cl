#include "core/compute/kernels/common.clh"
#include "core/compute/kernels/lanes.clh"
#include "core/segmentation/kernels/window_layout.h"

// Normals for segmentation, from the vertices alone: smooth on flat and convex surface, sharp where it is
// concave.
//
// A plane seen by a pinhole camera has an inverse depth that is linear in the pixel: 1/z = A (u - x) + B (v
// - y) + C around pixel (x, y). A least-squares fit over a window, of the readings within `gate` of the
// centre's depth, gives the plane m . p = 1 with m = (A fx, B fy, C + A (cx - x) + B (cy - y)) in the
// camera frame and the normal -m / |m| towards the camera. The surface is concave if the border of the window
// has a larger mean residual than its middle (a valley is nearer at its border). There a smoothing window
// would round off the crease that eq. 3.5 has to find, so the pixel takes the plane of the best fitting
// window around it (Kuwahara's filter). Such a window lies on one side of the crease.

/// One work-item: one pixel. vertices: width * height float4 in the world, w = 0: none. depth_row: the row
/// of T_camera_world that gives z. inverse_depth: 1 / z, 0 = none; the padding is not written.
kernel void invert_depth(global const float4* vertices, global float* inverse_depth, const int width, const int height,
                         const float4 depth_row) {
  const int x = get_global_id(0);
  const int y = get_global_id(1);
  if (x >= width || y >= height) return;
  const float4 v = vertices[y * width + x];
  const float z = dot(depth_row.xyz, v.xyz) + depth_row.w;
  const bool valid = v.w > 0.0f && z > 1e-3f && z < 1e6f;
  inverse_depth[(y + WINDOW_RADIUS) * WINDOW_STRIDE(width) + x + WINDOW_RADIUS] = valid ? 1.0f / z : 0.0f;
}

/// One work-item: the windows around LANES pixels in a row. planes: four images of height rows of `WINDOW_STRIDE`:
/// the normal's x, y, z in the camera frame and the window's RMS distance from its plane in metres, FLT_MAX
/// if there are too few readings. concavity: the same shape, metres by which the border rises above the
/// middle. Values right of the image are undefined.
kernel void fit_planes(global const float* restrict inverse_depth, global float* restrict planes,
                       global float* restrict concavity, const int width, const int height, const float4 K,
                       const float gate) {
  const int x = get_global_id(0) * LANES;
  const int y = get_global_id(1);
  if (x >= width || y >= height) return;
  const int stride = WINDOW_STRIDE(width);
  const floatN middle = LOAD(inverse_depth + (y + WINDOW_RADIUS) * stride + x + WINDOW_RADIUS);
  const floatN z = 1.0f / fmax(middle, 1e-6f);
  const floatN reach = gate * fmax(z * z, 1.0f) * middle * middle;  // the gate as a difference of inverse depths
  floatN n = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0, w = 0, uw = 0, vw = 0, ww = 0, ru = 0, rv = 0, rr = 0, rw = 0;
#pragma unroll
  for (int dy = -WINDOW_RADIUS; dy <= WINDOW_RADIUS; ++dy) {
#pragma unroll
    for (int dx = -WINDOW_RADIUS; dx <= WINDOW_RADIUS; ++dx) {
      const floatN reading = LOAD(inverse_depth + (y + WINDOW_RADIUS + dy) * stride + x + WINDOW_RADIUS + dx);
      const floatN e = reading - middle;
      const intN same = reading > 0.0f && fabs(e) <= reach;
      const floatN one = select((floatN)(0.0f), (floatN)(1.0f), same);
      const floatN ew = select((floatN)(0.0f), e, same);
      const float fx = (float)dx, fy = (float)dy, r = fx * fx + fy * fy;
      n += one;
      u += fx * one;
      v += fy * one;
      uu += fx * fx * one;
      uv += fx * fy * one;
      vv += fy * fy * one;
      ru += r * fx * one;
      rv += r * fy * one;
      rr += r * r * one;
      w += ew;
      uw += fx * ew;
      vw += fy * ew;
      rw += r * ew;
      ww += ew * e;
    }
  }
  const floatN share = 1.0f / fmax(n, 1.0f);
  const floatN cuu = uu - u * u * share, cuv = uv - u * v * share, cvv = vv - v * v * share;
  const floatN cuw = uw - u * w * share, cvw = vw - v * w * share, cww = ww - w * w * share;
  const floatN determinant = cuu * cvv - cuv * cuv;
  const intN fits = middle > 0.0f && n >= 5.0f && determinant > 1e-3f;
  const floatN scale = 1.0f / select((floatN)(1.0f), determinant, fits);
  const floatN A = (cuw * cvv - cvw * cuv) * scale;
  const floatN B = (cvw * cuu - cuw * cuv) * scale;
  const floatN C = middle + (w - A * u - B * v) * share;
  const floatN column = (float)x + convert_floatN(LANE);
  const floatN mx = A * K.x, my = B * K.y, mz = C + A * (K.z - column) + B * (K.w - (float)y);
  const floatN per_length = 1.0f / sqrt(fmax(mx * mx + my * my + mz * mz, 1e-30f));
  const floatN to_metres = z * per_length;  // of a residual in inverse depth: distance from the plane
  const floatN rms = sqrt(fmax(cww - A * cuw - B * cvw, 0.0f) * share) * to_metres;

  // Slope of the residual over r = dx^2 + dy^2, times r at the border of the window.
  const floatN r = uu + vv;
  const floatN crw = (rw - r * w * share) - A * (ru - r * u * share) - B * (rv - r * v * share);
  const floatN crr = rr - r * r * share;
  const floatN rise = crw / fmax(crr, 1e-6f) * (float)(WINDOW_RADIUS * WINDOW_RADIUS) * to_metres;

  const int target = y * stride + x;
  const int image = height * stride;
  STORE(-mx * per_length, planes + target);
  STORE(-my * per_length, planes + target + image);
  STORE(-mz * per_length, planes + target + 2 * image);
  STORE(select((floatN)(FLT_MAX), rms, fits), planes + target + 3 * image);
  STORE(rise, concavity + target);
}

/// One work-item: the normal of one pixel, in the world: (x, y, z, 1), or all 0 if no window around it
/// fits.
kernel void choose_normals(global const float* restrict inverse_depth, global const float* restrict planes,
                           global const float* restrict concavity, global float4* restrict normals, const int width,
                           const int height, const float16 T_world_camera, const float gate, const float concave_from) {
  const int x = get_global_id(0);
  const int y = get_global_id(1);
  if (x >= width || y >= height) return;
  const int stride = WINDOW_STRIDE(width);
  const int i = y * stride + x;
  const int image = height * stride;
  const float middle = inverse_depth[(y + WINDOW_RADIUS) * stride + x + WINDOW_RADIUS];
  int best = i;
  float best_rms = planes[i + 3 * image];
  if (middle > 0.0f && !(concavity[i] <= concave_from && best_rms < FLT_MAX)) {
    const float z = 1.0f / middle;
    const float reach = gate * fmax(1.0f, z * z) * middle * middle;
    for (int dy = -WINDOW_RADIUS; dy <= WINDOW_RADIUS; ++dy) {
      for (int dx = -WINDOW_RADIUS; dx <= WINDOW_RADIUS; ++dx) {
        const float reading = inverse_depth[(y + WINDOW_RADIUS + dy) * stride + x + WINDOW_RADIUS + dx];
        if (!(reading > 0.0f && fabs(reading - middle) <= reach)) continue;  // also excludes the padding
        const int j = i + dy * stride + dx;
        const float rms = planes[j + 3 * image];
        if (rms < best_rms) {
          best_rms = rms;
          best = j;
        }
      }
    }
  }
  const bool found = middle > 0.0f && best_rms < FLT_MAX;
  const float3 normal = (float3)(planes[best], planes[best + image], planes[best + 2 * image]);
  normals[y * width + x] = found ? (float4)(rotate_vector(T_world_camera, normal), 1.0f) : (float4)(0.0f);
}
