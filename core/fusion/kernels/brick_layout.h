// Layout of the brick map, shared by host (C++) and device (OpenCL C).
//
// Space is cut into voxels of `voxel_size`; voxel (x, y, z) spans [x, x + 1) * voxel_size and its centre,
// where its value is sampled, is (x + 0.5) * voxel_size. A brick holds 8^3 voxels; brick (bx, by, bz) starts
// at voxel 8 * (bx, by, bz). The brick table is an open-addressing hash table with linear probing; its
// capacity is a power of two. A brick's slot says where its voxels lie in every per-voxel pool: index = slot
// * BRICK_VOXELS + local, with local = x + 8 * (y + 8 * z).
#ifndef SCANTROVE_BRICK_LAYOUT_H
#define SCANTROVE_BRICK_LAYOUT_H

#define BRICK_SIDE 8
#define BRICK_SHIFT 3
#define BRICK_VOXELS 512
#define BRICK_NONE (-1)

typedef struct BrickEntry {
  int x, y, z;
  int slot; /* BRICK_NONE = free entry */
} BrickEntry;

/* Of each voxel there are, in pools of their own, so that rays and colours only read what they need:
   a signed distance  short, in units of truncation / DISTANCE_ONE; DISTANCE_UNSEEN where there is none yet,
                      which no distance is (one that rounds to it is the next larger)
   a weight           uchar, observations; 0 where there is no distance
   a label            label_voxel.h
   a colour           color_voxel.h */
#define VOXEL_BYTES 11 /* of all four */
#define DISTANCE_ONE 32767
#define DISTANCE_UNSEEN 0

/* Hash of a brick's position before masking with capacity - 1. */
static inline unsigned int brick_hash(int x, int y, int z) {
  unsigned int h = (unsigned int)x * 73856093u ^ (unsigned int)y * 19349669u ^ (unsigned int)z * 83492791u;
  h ^= h >> 16;
  h *= 0x7feb352du;
  h ^= h >> 15;
  return h;
}

#endif
