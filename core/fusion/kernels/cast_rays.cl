#include "core/fusion/kernels/brick_field.clh"

// The depth at which each pixel's ray first goes from + to - in the signed distance: steps through the nearest voxels, as long
// as their distance and a little more, find the pair of samples around it; then secant steps in the trilinear field find its zero.
// A ray that comes from - to + first has met a surface from behind and sees none.
//
// One work-item: 8 x 2 pixels, one per vector lane.
// ranges: (nearest, farthest) camera z of the bricks in view per tile of 8 x 8 pixels, ceil(width / 8) a row; nearest >=
// farthest = none. T_window_camera: camera metres to voxels of the window. depths: camera z, 0 = no surface,
// (height + 2 PAD) rows of 8 ceil(width / 8) + 2 PAD; only the inner ones are written.
#define OVERSHOOT 0.5f    /* voxels; lands behind the surface rather than creeping up to it */
#define UNSEEN_STEP 1.0f  /* voxels */
#define UNSEEN_GAP 3.0f   /* voxels */
#define BEHIND_FACE 0.05f /* voxels past a brick's face, to be safely in the next */

// Columns and rows of the 8 x 2 pixels of a work-item.
#define LANE_COLUMNS (float16)(0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7)
#define LANE_ROWS (float16)(0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1)

// Where the ray leaves the cube of `side` (a power of two) voxels around voxel i, along one axis.
inline float16 leave_cube(const float o, const float16 d, const float16 inverse_d, const int16 i, const int16 side) {
  const int16 low = i & -side;
  const float16 face = convert_float16(d > 0.0f ? low + side : low);
  return (face - o) * inverse_d;
}

// 1 / d, or so much that the ray never leaves along this axis.
inline float16 inverse_of(const float16 d) { return fabs(d) > 1e-6f ? 1.0f / d : (d > 0.0f ? 1e6f : -1e6f); }

kernel void cast_rays(global const float2* ranges, const int width, const int height, const float4 K,
                      const float16 T_window_camera, const float truncation_vox, global const int* cells,
                      global const int* page_slots, const int4 window_size, global const uint* voxels,
                      global float* depths) {
  const int column = (int)get_global_id(0);
  const int v = 2 * (int)get_global_id(1);
  const int columns = (width + 7) / 8;
  if (column >= columns || v >= height) return;
  const float2 range = ranges[(v / 8) * columns + column];
  const Field field = {cells, page_slots, voxels, window_size};

  // p(t) = o + t d, t = camera z in metres.
  const float16 T = T_window_camera;
  const float16 cx = (LANE_COLUMNS + (float)(8 * column) - K.z) / K.x;
  const float16 cy = (LANE_ROWS + (float)v - K.w) / K.y;
  const float ox = T.s3, oy = T.s7, oz = T.sb;
  const float16 dx = cx * T.s0 + (cy * T.s1 + T.s2);
  const float16 dy = cx * T.s4 + (cy * T.s5 + T.s6);
  const float16 dz = cx * T.s8 + (cy * T.s9 + T.sa);
  const float16 inverse_x = inverse_of(dx), inverse_y = inverse_of(dy), inverse_z = inverse_of(dz);
  const float16 t_voxel = 1.0f / sqrt(dx * dx + dy * dy + dz * dz);

  int16 active = (LANE_COLUMNS < (float)(width - 8 * column)) & (LANE_ROWS < (float)(height - v)) &
                 (range.x < range.y ? -1 : 0);
  int16 met = 0;
  float16 t = range.x;
  float16 t_before = 0.0f;
  float16 before = 0.0f; /* the distance at t_before; 0 = unknown */
  float16 now = 0.0f;
  while (any16(active)) {
    const int16 x = voxel_of(ox + t * dx);
    const int16 y = voxel_of(oy + t * dy);
    const int16 z = voxel_of(oz + t * dz);
    const int16 page = field_page(&field, x, y, z);
    const int16 slot = field_slot(&field, page, x, y, z);
    int16 seen;
    now = field_voxel(&field, slot, x, y, z, &seen);

    const int16 met_now = active & seen & (before > 0.0f) & (now <= 0.0f);
    const int16 from_behind = seen & (before < 0.0f) & (now > 0.0f);
    met |= met_now;
    active &= ~(met_now | from_behind);
    float16 next = t + t_voxel * (seen ? fabs(now) * truncation_vox + OVERSHOOT : UNSEEN_STEP);
    if (any16(active & (slot < 0))) {
      const int16 side = (int16)BRICK_SIDE << (slot < 0 ? -1 - slot : 0);
      const float16 leave = fmin(leave_cube(ox, dx, inverse_x, x, side),
                                fmin(leave_cube(oy, dy, inverse_y, y, side), leave_cube(oz, dz, inverse_z, z, side)));
      next = slot < 0 ? (leave > t ? leave : t) + BEHIND_FACE * t_voxel : next;
    }
    // Voxels never seen (a speck without depth) do not hide the surface that the last distance has announced.
    const int16 lost = ~seen & (t - t_before > (fabs(before) * truncation_vox + UNSEEN_GAP) * t_voxel);
    before = active ? (seen ? now : (lost ? 0.0f : before)) : before;
    t_before = active & seen ? t : t_before;
    t = active ? next : t;
    active &= t < range.y;
    // `now` of the lanes that met their surface is used below.
    if (any16(met_now)) {
      t = met_now ? t_before + (t - t_before) * before / (before - now) : t;
    }
  }

  float16 depth = 0.0f;
  if (any16(met)) {
    int16 known;
    const float16 metres = truncation_vox * t_voxel; /* of camera z for one truncation along the ray */
    float16 t0 = t;
    float16 f0 = field_at(&field, ox + t0 * dx, oy + t0 * dy, oz + t0 * dz, &known);
    met &= known;
    float16 t1 = t0 + f0 * metres;
#pragma unroll
    for (int i = 0; i < SECANT_STEPS; ++i) {
      const float16 f1 = field_at(&field, ox + t1 * dx, oy + t1 * dy, oz + t1 * dz, &known);
      const float16 slope = (f1 - f0) / (t1 - t0);
      // A slope that is not clearly downwards says nothing: step by the distance instead.
      const float16 step = slope * metres < -0.2f ? -f1 / slope : f1 * metres;
      const float16 limit = 2.0f * t_voxel;
      const float16 t2 = t1 + (step > limit ? limit : (step < -limit ? -limit : step));
      t0 = known ? t1 : t0;
      f0 = known ? f1 : f0;
      t1 = known ? t2 : t0;
    }
    depth = (met & (t1 > 0.0f)) ? t1 : 0.0f;
  }
  global float* out = depths + (v + PAD) * (8 * columns + 2 * PAD) + 8 * column + PAD;
  vstore8(depth.lo, 0, out);
  if (v + 1 < height) vstore8(depth.hi, 0, out + 8 * columns + 2 * PAD);
}
