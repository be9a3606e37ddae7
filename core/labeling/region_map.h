#pragma once
#include <cstdint>
#include <vector>

namespace scantrove {

/// S_cloud,t: the merged segmentation of one frame, on the host.
struct RegionMap {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t>
      labels;  ///< raw labels (immutable, what voxels hold), row by row; 0 = unlabelled
  std::vector<std::uint32_t> regions;  ///< the same resolved through the label table as known at this frame
};

}  // namespace scantrove
