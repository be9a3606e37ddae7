/* How the voxels of a brick are shared out, on host and device: a device of one lane has neighbouring
   work-items do neighbouring voxels, so that they are read together; with vectors one work-item does all of a
   brick. */
#ifndef SCANTROVE_BRICK_WORK_H
#define SCANTROVE_BRICK_WORK_H

#define BRICK_ITEMS(lanes) ((lanes) == 1 ? 64 : 1)

#endif
