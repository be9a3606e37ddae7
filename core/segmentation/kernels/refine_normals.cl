#include "core/compute/kernels/common.clh"

// Normals for segmentation, from the vertices alone: smooth on flat and convex surface, sharp where it is concave.
//
// A plane seen by a pinhole camera has an inverse depth that is linear in the pixel: 1/z = A (u - x) + B (v - y) + C
// around pixel (x, y). A least-squares fit over a window, of the readings within `gate` of the centre's depth, gives the plane m . p = 1
// with m = (A fx, B fy, C + A (cx - x) + B (cy - y)) in the camera frame and the normal -m / |m| towards the camera.
// The rim's mean residual above the middle's says whether the surface is concave (a valley is nearer at its rim). There a
// smoothing window would round off the very crease that eq. 3.5 is to find, so that there the pixel takes the plane of that window
// around it that fits best (Kuwahara's filter); such a window lies on one side of the crease.
//
// Build option -D RADIUS=r: windows of (2 r + 1)^2 pixels. `inverse_depth` is padded by RADIUS zeros on each side: its
// row has `stride` = width + 2 RADIUS elements.

#define SIDE (2 * RADIUS + 1)

/// One work-item: one pixel. vertices: width * height float4 in the world, w = 0: none. depth_row: the row of
/// T_camera_world that gives z. inverse_depth: 1 / z, 0 = none; the padding is not written.
kernel void invert_depth(global const float4* vertices, global float* inverse_depth, const int width, const int height,
                         const float4 depth_row) {
  const int x = get_global_id(0);
  const int y = get_global_id(1);
  if (x >= width || y >= height) return;
  const float4 v = vertices[y * width + x];
  const float z = dot(depth_row.xyz, v.xyz) + depth_row.w;
  const bool valid = v.w > 0.0f && z > 1e-3f && z < 1e6f;
  inverse_depth[(y + RADIUS) * (width + 2 * RADIUS) + x + RADIUS] = valid ? 1.0f / z : 0.0f;
}

/// One work-item: the window around one pixel. planes: width * height float4, the normal in the camera frame and the
/// window's RMS distance from its plane in metres; FLT_MAX where there are too few readings. concavity: metres by which the rim
/// stands out above the middle.
kernel void fit_planes(global const float* restrict inverse_depth, global float4* restrict planes,
                       global float* restrict concavity, const int width, const int height, const float4 K,
                       const float gate) {
  const int x = get_global_id(0);
  const int y = get_global_id(1);
  if (x >= width || y >= height) return;
  const int stride = width + 2 * RADIUS;
  const float middle = inverse_depth[(y + RADIUS) * stride + x + RADIUS];
  const float z = 1.0f / fmax(middle, 1e-6f);
  const float reach = gate * fmax(1.0f, z * z) * middle * middle;  // the gate as a difference of inverse depths
  float n = 0, u = 0, v = 0, uu = 0, uv = 0, vv = 0, w = 0, uw = 0, vw = 0, ww = 0, ru = 0, rv = 0, rr = 0, rw = 0;
#pragma unroll
  for (int dy = -RADIUS; dy <= RADIUS; ++dy) {
#pragma unroll
    for (int dx = -RADIUS; dx <= RADIUS; ++dx) {
      const float reading = inverse_depth[(y + RADIUS + dy) * stride + x + RADIUS + dx];
      const float e = reading - middle;
      const float one = reading > 0.0f && fabs(e) <= reach ? 1.0f : 0.0f;
      const float ew = one * e;
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
  const float share = 1.0f / fmax(n, 1.0f);
  const float cuu = uu - u * u * share, cuv = uv - u * v * share, cvv = vv - v * v * share;
  const float cuw = uw - u * w * share, cvw = vw - v * w * share, cww = ww - w * w * share;
  const float determinant = cuu * cvv - cuv * cuv;
  const bool fits = middle > 0.0f && n >= 5.0f && determinant > 1e-3f;
  const float scale = fits ? 1.0f / determinant : 0.0f;
  const float A = (cuw * cvv - cvw * cuv) * scale;
  const float B = (cvw * cuu - cuw * cuv) * scale;
  const float C = middle + (w - A * u - B * v) * share;
  const float mx = A * K.x, my = B * K.y, mz = C + A * (K.z - (float)x) + B * (K.w - (float)y);
  const float length = sqrt(mx * mx + my * my + mz * mz);
  const float per_length = fits ? 1.0f / length : 0.0f;
  const float to_metres = z * per_length;  // of a residual in inverse depth: distance from the plane
  const float rms = sqrt(fmax(cww - A * cuw - B * cvw, 0.0f) * share) * to_metres;

  // Slope of the residual over r = dx^2 + dy^2, times the rim's r.
  const float r = uu + vv;
  const float crw = (rw - r * w * share) - A * (ru - r * u * share) - B * (rv - r * v * share);
  const float crr = rr - r * r * share;
  const float rise = crr > 0.0f ? crw / crr * (float)(RADIUS * RADIUS) * to_metres : 0.0f;

  planes[y * width + x] = (float4)(-mx * per_length, -my * per_length, -mz * per_length, fits ? rms : FLT_MAX);
  concavity[y * width + x] = rise;
}

/// One work-item: the normal of one pixel, in the world: (x, y, z, 1), or all 0 where no window around it fits.
kernel void choose_normals(global const float* restrict inverse_depth, global const float4* restrict planes,
                           global const float* restrict concavity, global float4* restrict normals, const int width,
                           const int height, const float16 T_world_camera, const float gate, const float concave_from) {
  const int x = get_global_id(0);
  const int y = get_global_id(1);
  if (x >= width || y >= height) return;
  const int i = y * width + x;
  const int stride = width + 2 * RADIUS;
  const float middle = inverse_depth[(y + RADIUS) * stride + x + RADIUS];
  float4 best = planes[i];
  if (middle > 0.0f && !(concavity[i] <= concave_from && best.w < FLT_MAX)) {
    const float z = 1.0f / middle;
    const float reach = gate * fmax(1.0f, z * z) * middle * middle;
    for (int dy = -RADIUS; dy <= RADIUS; ++dy) {
      for (int dx = -RADIUS; dx <= RADIUS; ++dx) {
        const float reading = inverse_depth[(y + RADIUS + dy) * stride + x + RADIUS + dx];
        if (!(reading > 0.0f && fabs(reading - middle) <= reach)) continue;  // also all of the padding
        const float4 plane = planes[i + dy * width + dx];
        if (plane.w < best.w) best = plane;
      }
    }
  }
  const bool found = middle > 0.0f && best.w < FLT_MAX;
  normals[i] = found ? (float4)(rotate_vector(T_world_camera, best.xyz), 1.0f) : (float4)(0.0f);
}
