#pragma once
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/fusion/depth_view.h"

namespace scantrove {

/// What has come into the scene and stays there. A thing that moves is left out of the map until it has
/// rested for about a second; this remembers where it came to rest, so that it is known to be one thing, and
/// another one than what was there before, when it enters the map. One thread; forgets after some seconds, so
/// that cost and memory do not grow.
class AppearedObjects {
 public:
  /// The next frame: `moving` (CV_8UC1, 255 where something moves; empty: nowhere) and `intruding` (likewise:
  /// readings where there was nothing, FreeSpace::contradicting) have the size of the view.
  void add(const DepthView& view, const cv::Mat& moving, const cv::Mat& intruding);

  /// Of the frame that add() saw last: CV_8UC1, 1 .. 255 for the readings of each thing that has come and is
  /// still now, 0 elsewhere; empty: there is none.
  [[nodiscard]] cv::Mat atRest(const DepthView& view, const cv::Mat& moving) const;

  /// A cube of space in which something moved.
  struct Cell {
    std::array<int, 3> at;
    int since = 0, last = 0;  ///< frames: the first and the last in which it did
    int frames = 0;           ///< in how many
  };
  /// All that it knows.
  struct Memory {
    std::vector<Cell> cells;  ///< by place
    int frame = 0;            ///< that add() saw last
  };
  [[nodiscard]] const Memory& memory() const { return seen_; }
  void restoreState(Memory memory) { seen_ = std::move(memory); }

 private:
  /// None: nothing rested there.
  [[nodiscard]] const Cell* restingAt(const std::array<int, 3>& at) const;

  Memory seen_;
};

}  // namespace scantrove
