// One voxel of the label cloud, shared by host (C++) and device (OpenCL C):
// the fragment in the upper 24 bits, how sure it is (0 .. LABEL_CONFIDENCE_MAX) in the lower 8. 0 =
// unlabelled.
#ifndef SCANTROVE_LABEL_VOXEL_H
#define SCANTROVE_LABEL_VOXEL_H

#define LABEL_OF(voxel) ((voxel) >> 8)
#define CONFIDENCE_OF(voxel) ((voxel)&255u)
#define LABEL_VOXEL(label, confidence) (((label) << 8) | (confidence))
#define LABEL_CONFIDENCE_MAX 10u
#define LABEL_MAX 0xffffffu
#define LABEL_BRICK_UNUSED (-1)   /* stamp of a slot that no update has written to */
#define LABEL_AT_ONCE 0x80000000u /* of a pixel's new label: voxels take it whatever they hold */
#define LABEL_SURE 0x80000000u    /* of a pixel's projected label: its voxel is as sure as it can be */

/* A labelled voxel near the surface, as extract_points writes it. */
typedef struct LabelPoint {
  float x, y, z; /* world, metres */
  unsigned int fragment;
  float normal_x, normal_y, normal_z; /* unit, out of the surface; all 0 where it is not known */
  unsigned int color;                 /* the scene's, color_voxel.h; 0: not seen in colour */
  float height;                       /* over the surface along the normal, in voxels; 0 without normal */
} LabelPoint;

#endif
