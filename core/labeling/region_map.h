#pragma once
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// S_cloud,t: the merged segmentation of one frame, on the host. Both images row by row; none = unlabelled.
struct RegionMap {
  int width = 0;
  int height = 0;
  std::vector<FragmentId> fragments;  ///< what the voxels that are seen in each pixel are to hold
  std::vector<RegionId> regions;      ///< the same resolved as known at this frame
};

}  // namespace scantrove
