#ifndef SCANTROVE_THUMBNAIL_LAYOUT_H
#define SCANTROVE_THUMBNAIL_LAYOUT_H
// Valid in C++ and OpenCL C: how thumbnails lie in device memory, all signed 8-bit.
// A view: fine[3][32][32], coarse[3][16][16]. A query: for each of its variants the same with a rim of zeros
// around every plane, so that it can be read moved.
#define THUMBNAIL_VARIANTS 6  // mirror = variant / 3, scale = variant % 3
#define THUMBNAIL_SHIFTS 9    // coarse translation, (dy + 1) * 3 + dx + 1
#define THUMBNAIL_WARPS (THUMBNAIL_VARIANTS * THUMBNAIL_SHIFTS)
#define FINE_SIDE 32
#define FINE_RIM 4  // 2 for the coarse translation, 1 for the refinement, 1 for the local shift
#define FINE_STRIDE (FINE_SIDE + 2 * FINE_RIM)
#define COARSE_SIDE 16
#define COARSE_RIM 1
#define COARSE_STRIDE (COARSE_SIDE + 2 * COARSE_RIM)
#define FINE_VIEW_BYTES (3 * FINE_SIDE * FINE_SIDE)
#define COARSE_VIEW_BYTES (3 * COARSE_SIDE * COARSE_SIDE)
#define FINE_QUERY_BYTES (3 * FINE_STRIDE * FINE_STRIDE)        // of one variant
#define COARSE_QUERY_BYTES (3 * COARSE_STRIDE * COARSE_STRIDE)  // of one variant
#endif
