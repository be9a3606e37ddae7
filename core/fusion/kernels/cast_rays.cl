#include "core/fusion/kernels/brick_field.clh"
#include "core/fusion/kernels/ray_layout.h"

// The depth at which each pixel's ray first goes from + to - in the signed distance: steps through the nearest voxels, as long
// as their distance and a little more, find the pair of samples around it; then secant steps in the trilinear field find its zero.
// A ray that comes from - to + first has met a surface from behind and sees none.
//
// One work-item: LANES_X * LANES_Y pixels.
// ranges: (nearest, farthest) camera z of the bricks in view per tile of RAY_TILE^2 pixels, ceil(width / RAY_TILE) a row;
// nearest >= farthest = none. T_window_camera: camera metres to voxels of the window. depths: camera z, 0 = no surface,
// (height + 2 RAY_PAD) rows of RAY_STRIDE(width); only the inner ones are written.
#define OVERSHOOT 0.5f    /* voxels; lands behind the surface rather than creeping up to it */
#define UNSEEN_STEP 1.0f  /* voxels */
#define UNSEEN_GAP 3.0f   /* voxels */
#define BEHIND_FACE 0.05f /* voxels past a brick's face, to be safely in the next */
#define SECANT_STEPS 3

// Where the ray leaves the cube of `side` (a power of two) voxels around voxel i, along one axis.
inline floatN leave_cube(const float o, const floatN d, const floatN inverse_d, const intN i, const intN side) {
  const intN low = i & -side;
  const floatN face = convert_floatN(d > 0.0f ? low + side : low);
  return (face - o) * inverse_d;
}

// 1 / d, or so much that the ray never leaves along this axis.
inline floatN inverse_of(const floatN d) { return fabs(d) > 1e-6f ? 1.0f / d : (d > 0.0f ? 1e6f : -1e6f); }

kernel void cast_rays(global const float2* ranges, const int width, const int height, const float4 K,
                      const float16 T_window_camera, const float truncation_vox, global const int* cells,
                      global const int* page_slots, const int4 window_size, global const uint* voxels,
                      global float* depths) {
  const int u = LANES_X * (int)get_global_id(0);
  const int v = LANES_Y * (int)get_global_id(1);
  if (u >= width || v >= height) return;
  const float2 range = ranges[v / RAY_TILE * RAY_TILES(width) + u / RAY_TILE];
  const Field field = {cells, page_slots, voxels, window_size};

  // p(t) = o + t d, t = camera z in metres.
  const float16 T = T_window_camera;
  const floatN lane_x = convert_floatN(LANE_X);
  const floatN lane_y = convert_floatN(LANE_Y);
  const floatN cx = (lane_x + (float)u - K.z) / K.x;
  const floatN cy = (lane_y + (float)v - K.w) / K.y;
  const float ox = T.s3, oy = T.s7, oz = T.sb;
  const floatN dx = cx * T.s0 + (cy * T.s1 + T.s2);
  const floatN dy = cx * T.s4 + (cy * T.s5 + T.s6);
  const floatN dz = cx * T.s8 + (cy * T.s9 + T.sa);
  const floatN inverse_x = inverse_of(dx), inverse_y = inverse_of(dy), inverse_z = inverse_of(dz);
  const floatN t_voxel = 1.0f / sqrt(dx * dx + dy * dy + dz * dz);

  intN active = (lane_x < (float)(width - u)) & (lane_y < (float)(height - v)) &
                (range.x < range.y ? -1 : 0);
  intN met = 0;
  floatN t = range.x;
  floatN t_before = 0.0f;
  floatN before = 0.0f; /* the distance at t_before; 0 = unknown */
  floatN now = 0.0f;
  while (any_lane(active)) {
    const intN x = voxel_of(ox + t * dx);
    const intN y = voxel_of(oy + t * dy);
    const intN z = voxel_of(oz + t * dz);
    const intN page = field_page(&field, x, y, z);
    const intN slot = field_slot(&field, page, x, y, z);
    intN seen;
    now = field_voxel(&field, slot, x, y, z, &seen);

    const intN met_now = active & seen & (before > 0.0f) & (now <= 0.0f);
    const intN from_behind = seen & (before < 0.0f) & (now > 0.0f);
    met |= met_now;
    active &= ~(met_now | from_behind);
    floatN next = t + t_voxel * (seen ? fabs(now) * truncation_vox + OVERSHOOT : UNSEEN_STEP);
    if (any_lane(active & (slot < 0))) {
      const intN side = (intN)BRICK_SIDE << (slot < 0 ? -1 - slot : 0);
      const floatN leave = fmin(leave_cube(ox, dx, inverse_x, x, side),
                                fmin(leave_cube(oy, dy, inverse_y, y, side), leave_cube(oz, dz, inverse_z, z, side)));
      next = slot < 0 ? (leave > t ? leave : t) + BEHIND_FACE * t_voxel : next;
    }
    // Voxels never seen (a speck without depth) do not hide the surface that the last distance has announced.
    const intN lost = ~seen & (t - t_before > (fabs(before) * truncation_vox + UNSEEN_GAP) * t_voxel);
    before = active ? (seen ? now : (lost ? 0.0f : before)) : before;
    t_before = active & seen ? t : t_before;
    t = active ? next : t;
    active &= t < range.y;
    // `now` of the lanes that met their surface is used below.
    if (any_lane(met_now)) {
      t = met_now ? t_before + (t - t_before) * before / (before - now) : t;
    }
  }

  floatN depth = 0.0f;
  if (any_lane(met)) {
    intN known;
    const floatN metres = truncation_vox * t_voxel; /* of camera z for one truncation along the ray */
    floatN t0 = t;
    floatN f0 = field_at(&field, ox + t0 * dx, oy + t0 * dy, oz + t0 * dz, &known);
    met &= known;
    floatN t1 = t0 + f0 * metres;
#pragma unroll
    for (int i = 0; i < SECANT_STEPS; ++i) {
      const floatN f1 = field_at(&field, ox + t1 * dx, oy + t1 * dy, oz + t1 * dz, &known);
      const floatN slope = (f1 - f0) / (t1 - t0);
      // A slope that is not clearly downwards says nothing: step by the distance instead.
      const floatN step = slope * metres < -0.2f ? -f1 / slope : f1 * metres;
      const floatN limit = 2.0f * t_voxel;
      const floatN t2 = t1 + (step > limit ? limit : (step < -limit ? -limit : step));
      t0 = known ? t1 : t0;
      f0 = known ? f1 : f0;
      t1 = known ? t2 : t0;
    }
    depth = (met & (t1 > 0.0f)) ? t1 : 0.0f;
  }
  global float* out = depths + (v + RAY_PAD) * RAY_STRIDE(width) + u + RAY_PAD;
#if LANES_Y == 2
  STORE_H(depth.lo, out);
  if (v + 1 < height) STORE_H(depth.hi, out + RAY_STRIDE(width));
#else
  STORE(depth, out);
#endif
}
