#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/scan/frame_counts.h"

namespace scantrove {

/// Watches a scan as a whole: notices that it cannot come to much, and says why.
class ScanAdvisor {
 public:
  /// A map of so few frames holds nothing that is lost with it.
  static constexpr int kYoungMapFrames = 5;
  /// A second of a camera with 30 frames a second.
  static constexpr int kLostFrames = 30;

  /// `max_depth_m`: readings beyond it are not used.
  explicit ScanAdvisor(float max_depth_m) : max_depth_m_(max_depth_m) {}

  /// After each frame that reached the pipeline. A sentence, once, if most of what the frames show is beyond
  /// max_depth_m.
  [[nodiscard]] std::optional<Error> addFrame(const RgbdFrame& frame, bool is_usable);
  /// After each frame whose pose was refused.
  void addRefused() { ++lost_in_a_row_; }
  /// The map is young, and the camera has been lost for a second: the frames it began with misled it.
  [[nodiscard]] bool isMisled() const {
    return usable_ > 0 && usable_ <= kYoungMapFrames && lost_in_a_row_ >= kLostFrames;
  }
  /// A new map begins. What to say of that.
  [[nodiscard]] Error beginAnew(int frame_index);
  /// At the end of a scan: what to say of frames without a pose, if they are most of them.
  [[nodiscard]] static std::optional<Error> adviceOn(const FrameCounts& frames);

 private:
  [[nodiscard]] std::optional<Error> adviceOnDepth(const RgbdFrame& frame);

  float max_depth_m_;
  int usable_ = 0;  // frames of the map
  int lost_in_a_row_ = 0;
  int looked_at_ = 0, far_ = 0;  // frames, and those that are mostly too far away
  double far_share_ = 0;         // sum over the latter
};

}  // namespace scantrove
