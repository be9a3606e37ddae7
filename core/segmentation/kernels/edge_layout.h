// The pixel graph of one frame, shared by host (C++) and device (OpenCL C).
//
// Pixel p = y * width + x has EDGE_DIRECTIONS forward edges; edge e = p * EDGE_DIRECTIONS + direction leads
// to its neighbour in the East, South, South-East or South-West, so that each pair of neighbours has
// exactly one edge.
//
// A weight w in [0, 4] (eq. 3.5) is a 16-bit key: the bits of its float, less those of EDGE_WEIGHT_FLOOR,
// without the last 12. That is monotone, and as fine relative to w everywhere (1/2048): weights near 0,
// where all decisions fall, need it. Weights under the floor (where 1 - n.n is float rounding) become it.
#ifndef SCANTROVE_EDGE_LAYOUT_H
#define SCANTROVE_EDGE_LAYOUT_H

#define EDGE_DIRECTIONS 4
#define EDGE_EAST 0
#define EDGE_SOUTH 1
#define EDGE_SOUTH_EAST 2
#define EDGE_SOUTH_WEST 3

#define EDGE_KEY_SHIFT 12
#define EDGE_WEIGHT_FLOOR_BITS 0x33800000u /* 2^-24 */
#define EDGE_WEIGHT_FLOOR 5.9604644775390625e-8f
#define EDGE_KEYS (((0x40800000u - EDGE_WEIGHT_FLOOR_BITS) >> EDGE_KEY_SHIFT) + 1u) /* of 2^-24 .. 4 */
#define EDGE_NEVER 65535 /* MAXWGHT: the key of an edge that never joins */

#endif
