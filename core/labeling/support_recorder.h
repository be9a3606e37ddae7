#pragma once
#include <span>
#include <vector>

#include "core/capture/intrinsics.h"
#include "core/labeling/region_table.h"
#include "core/segmentation/segment_map.h"

namespace scantrove {

/// Records how often fragments were seen as a support or on one. One thread. Reads every fourth pixel.
class SupportRecorder {
 public:
  /// The next frame's segments and fragments, of the size of `K`.
  void record(const SegmentMap& segments, std::span<const FragmentId> fragments, const Intrinsics& K,
              RegionTable& table);

 private:
  std::vector<SupportPixels> pixels_;  // by fragment; zero between frames
  std::vector<FragmentId> in_view_;    // of the frame
};

}  // namespace scantrove
