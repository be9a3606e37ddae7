// The colour of one voxel, shared by host (C++) and device (OpenCL C): the running mean of what was seen of
// it, a byte each for red, green and blue from the lowest on, and in the highest byte the weight of that
// mean. 0 = never seen in colour.
#ifndef SCANTROVE_COLOR_VOXEL_H
#define SCANTROVE_COLOR_VOXEL_H

#define COLOR_RED(voxel) ((voxel)&255u)
#define COLOR_GREEN(voxel) (((voxel) >> 8) & 255u)
#define COLOR_BLUE(voxel) (((voxel) >> 16) & 255u)
#define COLOR_WEIGHT(voxel) ((voxel) >> 24)
#define COLOR_VOXEL(red, green, blue, weight) ((red) | ((green) << 8) | ((blue) << 16) | ((weight) << 24))

/* Pixels of the depth camera are rated by cells of COLOR_CELL^2. */
#define COLOR_CELL 2

/* A view weighs COLOR_WEIGHT_ONE at 1 m, straight on; see rate_pixels.cl. */
#define COLOR_WEIGHT_ONE 32.0f
#define COLOR_WEIGHT_OF_VIEW_MAX 64.0f
/* So that what is seen now and better always counts. */
#define COLOR_WEIGHT_MAX 255.0f

/* Of a cell of pixels, in one word: a distance in steps of COLOR_REACH_STEP_M, below it a weight of 8 bits.
 */
#define COLOR_RATING(reach_steps, weight) (((reach_steps) << 8) | (weight))
#define COLOR_RATING_REACH(rating) ((rating) >> 8)
#define COLOR_RATING_WEIGHT(rating) ((rating)&255u)
#define COLOR_REACH_STEP_M 0.0000625f
#define COLOR_REACH_STEPS_MAX 65535.0f

#endif
