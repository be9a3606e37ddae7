#include "core/fusion/kernels/brick_field.clh"
#include "core/fusion/kernels/ray_layout.h"

// The depth at which each pixel's ray first changes from + to - in the signed distance. Steps slightly longer than the distance
// of the nearest voxel find the pair of samples around it; then secant steps in the trilinear field find its zero.
// A ray that changes from - to + first hits a surface from behind and gets no depth.
//
// One work-item: RAY_BLOCKS(LANES) blocks of LANES_X * LANES_Y pixels, side by side. Memory accesses take most of the time, so
// the blocks take turns while voxels load.
// ranges: (nearest, farthest) camera z of the bricks in view per tile of RAY_TILE^2 pixels, ceil(width / RAY_TILE) a row;
// nearest >= farthest = none. T_window_camera: camera metres to voxels of the window. inverse_depths: 1 / camera z, 0 = no surface,
// (height + 2 RAY_PAD) rows of RAY_STRIDE(width); only the inner ones are written.
#define OVERSHOOT 0.5f    /* voxels; lands behind the surface rather than creeping up to it */
#define GAP_STEP 1.0f     /* voxels; through unseen voxels, after a positive distance */
#define GAP 3.0f          /* voxels; a longer unseen gap resets the last distance */
#define UNSEEN_STEP 0.5f  /* truncations; through unseen voxels without a positive distance before: a full truncation of distances
                             precedes each surface */
#define BEHIND_FACE 0.05f /* voxels past a brick's face, to be safely in the next */
#define SECANT_STEPS 3
#define CONVERGED 8e-3f   /* truncations: half a millimetre or less; the last step leaves much less */

// The rays o + t d of a block, t = camera z in metres, with the current t and the distance at the last seen voxel.
typedef struct Rays {
  floatN dx, dy, dz;
  floatN inverse_x, inverse_y, inverse_z;
  floatN t_voxel; /* one voxel along the ray */
  floatN t;
  floatN t_before;
  floatN before; /* the distance at t_before; 0 = unknown */
  intN active;
  intN met;
  float farthest;
} Rays;

// The current voxels of the rays.
typedef struct Place {
  intN x, y, z;
  intN slot;
} Place;

// The t at which the ray leaves the cube of `side` (a power of two) voxels around voxel i, along one axis.
inline floatN leave_cube(const float o, const floatN d, const floatN inverse_d, const intN i, const intN side) {
  const intN low = i & -side;
  const floatN face = convert_floatN(d > 0.0f ? low + side : low);
  return (face - o) * inverse_d;
}

// 1 / d, or a value so large that the ray never leaves along this axis.
inline floatN inverse_of(const floatN d) { return fabs(d) > 1e-6f ? 1.0f / d : (d > 0.0f ? 1e6f : -1e6f); }

inline Rays begin_rays(const float2 range, const int u, const int v, const int width, const int height, const float4 K,
                       const float16 T) {
  Rays rays;
  const floatN lane_x = convert_floatN(LANE_X);
  const floatN lane_y = convert_floatN(LANE_Y);
  const floatN cx = (lane_x + (float)u - K.z) / K.x;
  const floatN cy = (lane_y + (float)v - K.w) / K.y;
  rays.dx = cx * T.s0 + (cy * T.s1 + T.s2);
  rays.dy = cx * T.s4 + (cy * T.s5 + T.s6);
  rays.dz = cx * T.s8 + (cy * T.s9 + T.sa);
  rays.inverse_x = inverse_of(rays.dx);
  rays.inverse_y = inverse_of(rays.dy);
  rays.inverse_z = inverse_of(rays.dz);
  rays.t_voxel = 1.0f / sqrt(rays.dx * rays.dx + rays.dy * rays.dy + rays.dz * rays.dz);
  rays.farthest = range.y;
  rays.active = (lane_x < (float)(width - u)) & (lane_y < (float)(height - v)) & (range.x < range.y ? -1 : 0);
  rays.met = 0;
  rays.t = range.x;
  rays.t_before = 0.0f;
  rays.before = 0.0f;
  return rays;
}

inline Place place_of(const Field* field, const float3 o, const Rays* rays) {
  Place at;
  at.x = voxel_of(o.x + rays->t * rays->dx);
  at.y = voxel_of(o.y + rays->t * rays->dy);
  at.z = voxel_of(o.z + rays->t * rays->dz);
  at.slot = field_slot(field, field_page(field, at.x, at.y, at.z), at.x, at.y, at.z);
  return at;
}

inline void step_on(Rays* rays, const Place* at, const intN distance, const float3 o, const float truncation_vox) {
  const intN seen = where(distance != DISTANCE_UNSEEN);
  const floatN now = in_truncations(distance);
  const intN met_now = rays->active & seen & where(rays->before > 0.0f) & where(now <= 0.0f);
  const intN from_behind = seen & where(rays->before < 0.0f) & where(now > 0.0f);
  rays->met |= met_now;
  rays->active &= ~(met_now | from_behind);
  const floatN t = rays->t;
  const floatN unseen = rays->before > 0.0f ? GAP_STEP : UNSEEN_STEP * truncation_vox;
  floatN next = t + rays->t_voxel * (seen ? fabs(now) * truncation_vox + OVERSHOOT : unseen);
  if (any_lane(rays->active & where(at->slot < 0))) {
    const intN side = (intN)BRICK_SIDE << (at->slot < 0 ? -1 - at->slot : 0);
    const floatN leave = fmin(leave_cube(o.x, rays->dx, rays->inverse_x, at->x, side),
                              fmin(leave_cube(o.y, rays->dy, rays->inverse_y, at->y, side),
                                   leave_cube(o.z, rays->dz, rays->inverse_z, at->z, side)));
    next = at->slot < 0 ? (leave > t ? leave : t) + BEHIND_FACE * rays->t_voxel : next;
  }
  // The position between the pair of samples around the surface, once found.
  const floatN between = rays->t_before + (t - rays->t_before) * rays->before / (rays->before - now);
  // Few unseen voxels (a small hole in depth) do not reset the last distance.
  const intN lost =
      ~seen & where(t - rays->t_before > (fabs(rays->before) * truncation_vox + GAP) * rays->t_voxel);
  rays->before = rays->active ? (seen ? now : (lost ? 0.0f : rays->before)) : rays->before;
  rays->t_before = rays->active & seen ? t : rays->t_before;
  rays->t = rays->active ? next : (met_now ? between : t);
  rays->active &= where(rays->t < rays->farthest);
}

// The zero of the trilinear field near rays->t, 0 if none.
inline floatN refined_depth(const Field* field, const float3 o, const Rays* rays, const float truncation_vox) {
  if (!any_lane(rays->met)) return 0.0f;
  intN known;
  const floatN metres = truncation_vox * rays->t_voxel; /* of camera z for one truncation along the ray */
  floatN t0 = rays->t;
  floatN f0 = field_at(field, rays->met, o.x + t0 * rays->dx, o.y + t0 * rays->dy, o.z + t0 * rays->dz, &known);
  const intN met = rays->met & known;
  floatN t1 = t0 + f0 * metres;
#pragma unroll
  for (int i = 0; i < SECANT_STEPS; ++i) {
    const floatN f1 = field_at(field, met, o.x + t1 * rays->dx, o.y + t1 * rays->dy, o.z + t1 * rays->dz, &known);
    const intN is_near = known & where(fabs(f1) <= CONVERGED);
    const floatN slope = (f1 - f0) / (t1 - t0);
    // If the slope is not clearly negative, steps by the distance instead.
    const floatN step = slope * metres < -0.2f ? -f1 / slope : f1 * metres;
    const floatN limit = 2.0f * rays->t_voxel;
    const floatN t2 = t1 + (step > limit ? limit : (step < -limit ? -limit : step));
    t0 = known ? t1 : t0;
    f0 = known ? f1 : f0;
    t1 = known ? t2 : t0;
    if (!any_lane(met & ~is_near)) break;
  }
  return (met & (t1 > 0.0f)) ? t1 : 0.0f;
}

kernel void cast_rays(global const float2* ranges, const int width, const int height,
                      const float4 K, const float16 T_window_camera, const float truncation_vox, global const int* cells,
                      global const int* page_slots, const int4 window_size, global const short* distances,
                      global float* inverse_depths) {
  const int first = RAY_BLOCKS(LANES) * LANES_X * (int)get_global_id(0);
  const int v = LANES_Y * (int)get_global_id(1);
  if (first >= width || v >= height) return;
  const Field field = {cells, page_slots, distances, window_size};
  const float3 o = (float3)(T_window_camera.s3, T_window_camera.s7, T_window_camera.sb);

  Rays rays[RAY_BLOCKS(LANES)];
#pragma unroll
  for (int k = 0; k < RAY_BLOCKS(LANES); ++k) {
    // A block beyond the image has no active rays.
    const int u = first + k * LANES_X;
    const float2 range = ranges[v / RAY_TILE * RAY_TILES(width) + min(u, width - 1) / RAY_TILE];
    rays[k] = begin_rays(range, u, v, width, height, K, T_window_camera);
  }
  while (1) {
    intN going = rays[0].active;
#pragma unroll
    for (int k = 1; k < RAY_BLOCKS(LANES); ++k) going |= rays[k].active;
    if (!any_lane(going)) break;
    Place at[RAY_BLOCKS(LANES)];
    intN distance[RAY_BLOCKS(LANES)];
#pragma unroll
    for (int k = 0; k < RAY_BLOCKS(LANES); ++k) at[k] = place_of(&field, o, &rays[k]);
#pragma unroll
    for (int k = 0; k < RAY_BLOCKS(LANES); ++k) distance[k] = field_distance(&field, at[k].slot, at[k].x, at[k].y, at[k].z);
#pragma unroll
    for (int k = 0; k < RAY_BLOCKS(LANES); ++k) step_on(&rays[k], &at[k], distance[k], o, truncation_vox);
  }

#pragma unroll
  for (int k = 0; k < RAY_BLOCKS(LANES); ++k) {
    const int u = first + k * LANES_X;
    if (u >= width) continue;
    const floatN depth = refined_depth(&field, o, &rays[k], truncation_vox);
    const floatN inverse = depth > 0.0f ? 1.0f / depth : 0.0f;
    global float* out = inverse_depths + (v + RAY_PAD) * RAY_STRIDE(width) + u + RAY_PAD;
#if LANES_Y == 2
    STORE_H(inverse.lo, out);
    if (v + 1 < height) STORE_H(inverse.hi, out + RAY_STRIDE(width));
#else
    STORE(inverse, out);
#endif
  }
}
