#pragma once
#include <vector>

#include "core/fusion/rendered_view.h"
#include "core/labeling/region_table.h"
#include "core/segmentation/segment_map.h"

namespace scantrove {

/// Records how often fragments were seen as a support or on one. One thread. Reads every fourth pixel.
class SupportRecorder {
 public:
  /// The next frame's segments, and its view with fragments, of the same size.
  void record(const SegmentMap& segments, const RenderedView& view, RegionTable& table);

 private:
  std::vector<SupportPixels> pixels_;  // by fragment; zero between frames
  std::vector<FragmentId> in_view_;    // of the frame
};

}  // namespace scantrove
