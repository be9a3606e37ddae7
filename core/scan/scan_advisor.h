#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/scan/frame_counts.h"

namespace scantrove {

/// Monitors a scan and warns the user when its results will be poor, with the reason.
class ScanAdvisor {
 public:
  /// A map of so few frames can be dropped without loss.
  static constexpr int kYoungMapFrames = 5;
  /// One second at 30 frames a second.
  static constexpr int kLostFrames = 30;

  /// `max_depth_m`: readings beyond it are not used.
  explicit ScanAdvisor(float max_depth_m) : max_depth_m_(max_depth_m) {}

  /// Call after each frame that reached the pipeline. Returns a sentence, once, if most of the surface is
  /// beyond max_depth_m.
  [[nodiscard]] std::optional<Error> addFrame(const RgbdFrame& frame, bool is_usable);
  /// Call after each frame whose pose was rejected.
  void addRefused() { ++lost_in_a_row_; }
  /// Whether the map is young and tracking was lost for a second: its first frames were misleading.
  [[nodiscard]] bool isMisled() const {
    return usable_ > 0 && usable_ <= kYoungMapFrames && lost_in_a_row_ >= kLostFrames;
  }
  /// A new map begins; returns the message for that.
  [[nodiscard]] Error restart(int frame_index);
  /// At the end of a scan: advice if most frames have no pose, or one that the map does not confirm.
  [[nodiscard]] static std::optional<Error> adviceOn(const FrameCounts& frames);

 private:
  [[nodiscard]] std::optional<Error> adviceOnDepth(const RgbdFrame& frame);

  float max_depth_m_;
  int usable_ = 0;  // frames of the map
  int lost_in_a_row_ = 0;
  int judged_frames_ = 0, far_ = 0;  // frames, and those that are mostly too far away
  double far_share_ = 0;             // sum over those frames
};

}  // namespace scantrove
