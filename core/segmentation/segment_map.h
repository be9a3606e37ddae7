#pragma once
#include <cstdint>
#include <vector>

namespace scantrove {

/// S_t: the segments of one frame, on the host.
struct SegmentMap {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> ids;  ///< width * height, row by row; 0 = unlabelled, else 1 .. count()
  std::vector<int> areas;          ///< pixels of each id; areas[0] = unlabelled pixels
  std::vector<float> depths_m;     ///< width * height: z in the camera of each labelled pixel, else 0

  [[nodiscard]] int count() const { return areas.empty() ? 0 : static_cast<int>(areas.size()) - 1; }
};

}  // namespace scantrove
