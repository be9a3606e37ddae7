// Projection of the label cloud to the current view (thesis 3.3.3):
//   S_prj,t(u) = raw label of voxel floor(V_t(u) / voxel_size)
// One work-item: LANES pixels.
//   vertices   pixels x float4, world, w = 0: no surface
//   cells, page_slots, window_size  the view's window (brick_page.h); first: the brick at which it starts
//   labels     slots x 512 label voxels; stamps: LABEL_BRICK_UNUSED for slots without any written label
//   projected  pixels, out: raw label, with LABEL_SURE if the voxel's confidence is full; or 0
#include "core/fusion/kernels/brick_field.clh"
#include "core/labeling/kernels/label_voxel.h"

kernel void project_labels(global const float4* vertices, const int pixels, global const int* cells,
                           global const int* page_slots, const int4 window_size, const int4 first,
                           global uint* labels, global const int* stamps, const float voxels_per_metre, global uint* projected) {
  const int begin = LANES * (int)get_global_id(0);
  if (begin >= pixels) return;
  const Field field = {cells, page_slots, 0, window_size};
  const Points v = points_at(vertices, min(begin + LANE, (intN)(pixels - 1)));
  const intN place = field_places(&field, first, v, voxels_per_metre);
  const intN found = place >= 0;
  const intN unused = found & where(GATHER(intN, stamps, found ? place / BRICK_VOXELS : 0) == LABEL_BRICK_UNUSED);
  if (any_lane(unused)) {
    int places[LANES], is_unused[LANES];
    STORE(place, places);
    STORE(unused, is_unused);
    for (int lane = 0; lane < LANES; ++lane)
      if (is_unused[lane]) write_before_read(labels + places[lane]);
  }
  const uintN held = GATHER(uintN, labels, found ? place : 0);
  const uintN sure = CONFIDENCE_OF(held) >= LABEL_CONFIDENCE_MAX ? (uintN)(LABEL_SURE) : (uintN)(0u);
  const uintN label = found ? LABEL_OF(held) | sure : 0u;
  STORE_FIRST(uint, label, projected + begin, pixels - begin);
}
