/* Sums of one ICP pass, shared by host (C++) and device (OpenCL C): ICP_SUMS floats, an 8 x 8 matrix row by
   row. Rows 0..5: sum w J_i (J_0 .. J_5, r); row 6: sum w r (J_0 .. J_5, r); the other places are named
   below. */
#ifndef SCANTROVE_ICP_LAYOUT_H
#define SCANTROVE_ICP_LAYOUT_H

#define ICP_SUMS 64
#define ICP_FIT_WEIGHT 7 /* sum h */
#define ICP_FIT_ERROR 15 /* sum h r^2 */
#define ICP_BEFORE 23   /* pixels of the overlap that lie before the model's surface, by more than the gate */
#define ICP_BEHIND 31   /* pixels of the overlap that lie behind it likewise */
#define ICP_INLIERS 56  /* pixels associated */
#define ICP_OVERLAP 57  /* pixels with depth that project onto a pixel of the model that has a surface */
#define ICP_READINGS 58 /* pixels with depth */
#define ICP_POINT 59    /* three sums: p - centre over the inliers */
#define ICP_POINT_2 62  /* sum |p - centre|^2 over the inliers */
#define ICP_ERROR 63    /* sum r^2 over the inliers, unweighted */

#endif
