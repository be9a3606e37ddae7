// One voxel of the label cloud, shared by host (C++) and device (OpenCL C):
// the raw label in the upper 24 bits, how sure it is (0 .. LABEL_CONFIDENCE_MAX) in the lower 8. 0 =
// unlabelled.
#ifndef SCANTROVE_LABEL_VOXEL_H
#define SCANTROVE_LABEL_VOXEL_H

#define LABEL_OF(voxel) ((voxel) >> 8)
#define CONFIDENCE_OF(voxel) ((voxel)&255u)
#define LABEL_VOXEL(label, confidence) (((label) << 8) | (confidence))
#define LABEL_CONFIDENCE_MAX 10u
#define LABEL_MAX 0xffffffu

/* A labelled voxel near the surface, as extract_points writes it. */
typedef struct LabelPoint {
  float x, y, z; /* world, metres */
  unsigned int label;
} LabelPoint;

#endif
