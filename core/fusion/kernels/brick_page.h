// Pages of the brick map, shared by host (C++) and device (OpenCL C).
//
// A page is a cube of 8^3 bricks: PAGE_BRICKS slots, local brick index x + 8 * (y + 8 * z). Where there is no
// brick the slot is negative and tells how far that goes: PAGE_EMPTY_CUBE(level) = the aligned cube of
// (2^level)^3 bricks around it is empty (level 0 is BRICK_NONE). Page 0 is empty for ever, so that "no page"
// needs no branch. A window is the box of pages around one view: a dense grid of page indices, x fastest.
// Kernels count bricks and voxels from the window's first brick, which keeps their floats small wherever in
// space the camera is.
#ifndef SCANTROVE_BRICK_PAGE_H
#define SCANTROVE_BRICK_PAGE_H

#define PAGE_SIDE 8
#define PAGE_SHIFT 3
#define PAGE_BRICKS 512
#define PAGE_EMPTY 0
#define PAGE_EMPTY_CUBE(level) (-1 - (level))

#endif
