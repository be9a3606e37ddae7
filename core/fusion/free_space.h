#pragma once
#include <deque>
#include <opencv2/core/mat.hpp>
#include <utility>

#include "core/fusion/depth_view.h"

namespace scantrove {

/// Recent free space, from a few of the last views. A reading there belongs to something that has just come.
/// One thread at a time; the cost does not depend on the scanned volume.
class FreeSpace {
 public:
  /// `depth_noise_m`: FusionParams.
  explicit FreeSpace(float depth_noise_m) : depth_noise_m_(depth_noise_m) {}

  /// The readings of `now` in the free space of at least two of the last views, beyond noise and edges:
  /// CV_8UC1, 255 for such a reading, else 0.
  [[nodiscard]] cv::Mat contradicting(const DepthView& now) const;

  /// Adds a view. Keeps every fourth, and the last seven of these: about a second of a recording.
  void add(const DepthView& view);

  /// One of the last views.
  struct Witness {
    Intrinsics K;
    Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
    cv::Mat nearest_m;  ///< CV_32FC1: the nearest of the readings around each reading; 0 without reading
  };
  /// The complete state.
  struct Memory {
    std::deque<Witness> witnesses;
    int views = 0;  ///< added so far
  };
  [[nodiscard]] const Memory& memory() const { return seen_; }
  void restoreState(Memory memory) { seen_ = std::move(memory); }

 private:
  Memory seen_;
  float depth_noise_m_;
};

}  // namespace scantrove
