#pragma once
#include <Eigen/Core>
#include <map>
#include <vector>

#include "core/fusion/rendered_view.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// Records from which directions fragments were seen. A frame's direction is taken from the centre of the
/// visible part of the fragment's region. One thread. Reads every fourth pixel.
class ObservationRecorder {
 public:
  /// A region needs one in kMinPart of the image's pixels, and at least kMinPixels, to count as observed.
  static constexpr int kMinPart = 1500;
  static constexpr int kMinPixels = 16;  ///< every fourth is read; means of fewer are noise

  /// The next frame's view, with its fragments.
  void record(const RenderedView& view, RegionTable& table);

 private:
  struct Seen {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    int points = 0;
  };
  std::vector<Seen> seen_;            // by fragment; zero between frames
  std::map<RegionId, Seen> regions_;  // of the frame
  std::vector<FragmentId> in_view_;   // of the frame
};

}  // namespace scantrove
