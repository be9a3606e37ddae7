// Sets voxels to a fragment with full confidence. Voxels without label or brick stay as they are.
// One work-item: one voxel.
//   listed    voxels x, y, z (brick_layout.h), each once
//   labels    slots x 512 label voxels
//   fragment_voxels  number of voxels of each fragment
#include "core/fusion/kernels/brick_lookup.clh"
#include "core/labeling/kernels/label_voxel.h"

kernel void relabel_voxels(global const int4* listed, const int count, const uint fragment,
                           global const BrickEntry* table, const uint mask, global uint* labels,
                           global int* fragment_voxels) {
  const int i = get_global_id(0);
  if (i >= count) return;
  const int4 v = listed[i];
  const int slot = find_brick(table, mask, v.x >> BRICK_SHIFT, v.y >> BRICK_SHIFT, v.z >> BRICK_SHIFT);
  if (slot == BRICK_NONE) return;
  global uint* voxel = labels + slot * BRICK_VOXELS + (v.x & 7) + 8 * ((v.y & 7) + 8 * (v.z & 7));
  const uint before = LABEL_OF(*voxel);
  if (before == 0u) return;
  *voxel = LABEL_VOXEL(fragment, LABEL_CONFIDENCE_MAX);
  if (before == fragment) return;
  atomic_dec(fragment_voxels + before);
  atomic_inc(fragment_voxels + fragment);
}
