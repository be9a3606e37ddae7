/* Frame of zeros around a depth plane, shared by host and device; see depth_plane.clh. */
#ifndef SCANTROVE_DEPTH_PLANE_H
#define SCANTROVE_DEPTH_PLANE_H

#define PLANE_PAD 2  /* zeros before the first and after the last pixel of every row and column */
#define PLANE_RUN 16 /* rows hold a whole number of runs of so many pixels, for the lanes of any device */

#endif
