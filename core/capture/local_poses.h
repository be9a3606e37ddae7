#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Moves a recording's poses to an origin near the first one, in whole metres, because a single-precision map
/// cannot represent positions many kilometres away. Frames with implausible poses become skipped frames with
/// a message, or lose their poses. Frames without a pose pass.
class LocalPoses final : public FrameSource {
 public:
  /// Poses within this distance of the recording's own origin keep that origin.
  static constexpr double kNearOrigin_m = 100;
  /// Single precision resolves half a millimetre there.
  static constexpr double kFarthest_m = 5000;
  /// Maximum motion between two frames.
  static constexpr double kLongestJump_m = 100;

  /// What becomes of a frame with an implausible pose.
  enum class Implausible {
    skipped,      ///< the frame is left out: its pose is needed
    without_pose  ///< it stays without its pose, which is only a prediction; the first one is in the log
  };

  /// `origin`: of the scan that this recording continues; none: the first pose decides.
  LocalPoses(std::unique_ptr<FrameSource> source, const std::optional<Eigen::Vector3d>& origin,
             Implausible implausible = Implausible::skipped)
      : source_(std::move(source)), origin_(origin), implausible_(implausible) {}

  [[nodiscard]] const SourceInfo& info() const override { return source_->info(); }
  [[nodiscard]] FrameRead next() override { return moved(source_->next()); }
  [[nodiscard]] std::optional<FrameRead> nextIfReady() override;

  /// The origin in the recording's world. Zero before the first pose.
  [[nodiscard]] Eigen::Vector3d origin() const { return origin_.value_or(Eigen::Vector3d::Zero()); }
  /// The next pose is the first.
  void forget();

 private:
  [[nodiscard]] FrameRead moved(FrameRead read);
  /// Why the pose is implausible; empty: it is plausible.
  [[nodiscard]] std::string refusalOf(const Eigen::Isometry3d& T_world_camera);
  [[nodiscard]] bool isJump(const Eigen::Vector3d& place);

  std::unique_ptr<FrameSource> source_;
  std::optional<Eigen::Vector3d> origin_;
  Implausible implausible_;
  bool has_reported_ = false;                 // that a pose was implausible
  std::optional<Eigen::Vector3d> last_;       // of the last frame returned
  std::optional<Eigen::Vector3d> elsewhere_;  // of the last pose that jumped away from it
  int agreeing_ = 0;                          // consecutive frames near elsewhere_
};

}  // namespace scantrove
