// Pages of the brick map, shared by host (C++) and device (OpenCL C).
//
// A page is a cube of 8^3 bricks: PAGE_BRICKS slots (BRICK_NONE where there is no brick), local brick index
// x + 8 * (y + 8 * z). Page 0 is empty for ever, so that "no page" needs no branch.
// A window is the box of pages around one view: a dense grid of page indices, x fastest. Kernels count bricks and voxels from
// the window's first brick, which keeps their floats small wherever in space the camera is.
#ifndef SCANTROVE_BRICK_PAGE_H
#define SCANTROVE_BRICK_PAGE_H

#define PAGE_SIDE 8
#define PAGE_SHIFT 3
#define PAGE_BRICKS 512
#define PAGE_EMPTY 0

#endif
