#pragma once
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/fusion/depth_view.h"

namespace scantrove {

/// Objects that entered the scene and came to rest. A moving object is left out of the map until it has
/// rested for about a second. This class remembers where it came to rest. When it enters the map, it is then
/// one object, separate from the surface that was there before. Forgets after some seconds, which bounds cost
/// and memory. One thread.
class AppearedObjects {
 public:
  /// Adds a frame. `moving` (CV_8UC1, 255 where something moves; empty: nowhere) and `intruding` (likewise:
  /// readings in former free space, FreeSpace::contradicting) have the size of the view.
  void add(const DepthView& view, const cv::Mat& moving, const cv::Mat& intruding);

  /// For the last frame of add(): CV_8UC1, 1 .. 255 for the readings of each appeared object at rest, 0
  /// elsewhere. Empty if there is none.
  [[nodiscard]] cv::Mat atRest(const DepthView& view, const cv::Mat& moving) const;

  /// A cube of space in which something moved.
  struct Cell {
    std::array<int, 3> at;
    int since = 0, last = 0;  ///< first and last frame with motion
    int frames = 0;           ///< number of frames with motion
  };
  /// The complete state.
  struct Memory {
    std::vector<Cell> cells;  ///< by place
    int frame = 0;            ///< last frame of add()
  };
  [[nodiscard]] const Memory& memory() const { return seen_; }
  void restoreState(Memory memory) { seen_ = std::move(memory); }

 private:
  /// Null if nothing rested there.
  [[nodiscard]] const Cell* restingAt(const std::array<int, 3>& at) const;

  Memory seen_;
};

}  // namespace scantrove
