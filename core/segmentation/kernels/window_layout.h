// The padded images of refine_normals.cl, shared by host (C++) and device (OpenCL C).
//
// Windows have (2 WINDOW_RADIUS + 1)^2 pixels. An image of inverse depths has WINDOW_RADIUS zeros on each
// side and its rows are filled up with zeros to WINDOW_STRIDE elements, so that a vector of up to WINDOW_RUN
// windows needs no test of its bounds.
#ifndef SCANTROVE_WINDOW_LAYOUT_H
#define SCANTROVE_WINDOW_LAYOUT_H

#define WINDOW_RADIUS 2
#define WINDOW_RUN 16
#define WINDOW_STRIDE(width) (((width) + WINDOW_RUN - 1) / WINDOW_RUN * WINDOW_RUN + 2 * WINDOW_RADIUS)

#endif
