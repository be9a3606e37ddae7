/* The images of cast_rays and fit_planes, shared by host and device. */
#ifndef SCANTROVE_RAY_LAYOUT_H
#define SCANTROVE_RAY_LAYOUT_H

// Rays of a tile of RAY_TILE x RAY_TILE pixels share their range. Rows hold a whole number of runs of RAY_RUN
// pixels, for the lanes of any device, and RAY_PAD pixels lie around an image, so that windows of planes need
// no test of its bounds.
#define RAY_TILE 8
#define RAY_PAD 4
#define RAY_RUN 16
#define RAY_TILES(pixels) (((pixels) + RAY_TILE - 1) / RAY_TILE)
#define RAY_STRIDE(width) (((width) + RAY_RUN - 1) / RAY_RUN * RAY_RUN + 2 * RAY_PAD)

#define RAY_BLOCKS(lanes) ((lanes) < 8 ? 1 : 4) /* blocks of lanes of a work-item, cast_rays.cl */

#define FIT_RADIUS 3   /* pixels; a plane is fitted to (2 FIT_RADIUS + 1)^2 of them */
#define FIT_SLOPE 3.0f /* see fit_planes.cl */
#define NO_PLANE 1e30f /* residual where there is none */

#endif
