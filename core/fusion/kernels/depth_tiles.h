/* Tiles of reduce_depth_tiles, shared by host and device. */
#ifndef SCANTROVE_DEPTH_TILES_H
#define SCANTROVE_DEPTH_TILES_H

#define DEPTH_TILE 8 /* pixels along each side */
#define DEPTH_TILES(pixels) (((pixels) + DEPTH_TILE - 1) / DEPTH_TILE)

#endif
