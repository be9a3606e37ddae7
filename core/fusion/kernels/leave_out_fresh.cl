// Normals of surface with at least `settled` observations at its voxel; elsewhere all 0. counts: adds the pixels with fresh
// surface, and with any surface.
// One work-item: LANES pixels. vertices: world, w = 0: no surface. cells, page_slots, window_size: the view's window
// (brick_page.h); first: the brick at which it starts. weights: BRICK_VOXELS per slot.
#include "core/fusion/kernels/brick_field.clh"

kernel void leave_out_fresh(global const float4* vertices, global const float4* normals, const int pixels,
                            global const int* cells, global const int* page_slots, const int4 window_size,
                            const int4 first, global const uchar* weights, const float voxels_per_metre,
                            const int settled, global float4* settled_normals, volatile global int* counts) {
  const int begin = LANES * (int)get_global_id(0);
  if (begin >= pixels) return;
  const Field field = {cells, page_slots, 0, window_size};
  const intN pixel = begin + LANE;
  const Points v = points_at(vertices, min(pixel, (intN)(pixels - 1)));
  const intN met = where(pixel < pixels) & where(v.w > 0.0f);
  const intN place = field_places(&field, first, v, voxels_per_metre);
  const intN found = met & where(place >= 0);
  const intN weight = GATHER_UCHAR(weights, found ? place : 0);
  const intN is_settled = found & where(weight >= settled);
  int settled_lanes[LANES];
  STORE(is_settled, settled_lanes);
  for (int i = 0; i < min(LANES, pixels - begin); ++i)
    settled_normals[begin + i] = settled_lanes[i] ? normals[begin + i] : (float4)(0.0f);
  const int with_surface = (int)sum_of_lanes(one_where(met));
  const int fresh = with_surface - (int)sum_of_lanes(one_where(is_settled));
  if (fresh > 0) atomic_add(counts, fresh);
  if (with_surface > 0) atomic_add(counts + 1, with_surface);
}
