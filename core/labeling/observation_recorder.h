#pragma once
#include <Eigen/Core>
#include <map>
#include <vector>

#include "core/fusion/rendered_view.h"
#include "core/labeling/region_table.h"

namespace scantrove {

/// Learns from each frame from which directions the fragments in it are seen: those from the middle of what
/// is seen of their region, as they are parts of one thing. One thread; cost: a read of every fourth pixel.
class ObservationRecorder {
 public:
  /// Fewer of an image's pixels are no look: one in so many of the whole image, and so many at least.
  static constexpr int kMinPart = 1500;
  static constexpr int kMinPixels = 16;  ///< every fourth is read: means of fewer are noise

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
