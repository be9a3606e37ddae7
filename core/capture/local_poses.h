#pragma once
#include <Eigen/Geometry>
#include <memory>
#include <optional>

#include "core/capture/frame_source.h"

namespace scantrove {

/// A recording whose poses are moved to an origin near the first one, in whole metres: a map in single
/// precision holds nothing that is many kilometres away. Frames whose pose no camera of one scan can have
/// become skipped ones, with a sentence. Frames without a pose pass.
class LocalPoses final : public FrameSource {
 public:
  /// Poses no farther than this from the recording's own origin need no other.
  static constexpr double kNearOrigin_m = 100;
  /// Half a millimetre is what single precision tells apart there.
  static constexpr double kFarthest_m = 5000;
  /// From one frame to the next.
  static constexpr double kLongestJump_m = 100;

  /// `origin`: of the scan that goes on with this recording; none: the first pose decides.
  LocalPoses(std::unique_ptr<FrameSource> source, const std::optional<Eigen::Vector3d>& origin)
      : source_(std::move(source)), origin_(origin) {}

  [[nodiscard]] const SourceInfo& info() const override { return source_->info(); }
  [[nodiscard]] FrameRead next() override { return moved(source_->next()); }
  [[nodiscard]] std::optional<FrameRead> nextIfReady() override;

  /// In the recording's world. Zero before the first pose.
  [[nodiscard]] Eigen::Vector3d origin() const { return origin_.value_or(Eigen::Vector3d::Zero()); }
  /// The next pose is the first.
  void forget();

 private:
  [[nodiscard]] FrameRead moved(FrameRead read);
  /// Why it is none; empty: it is one.
  [[nodiscard]] std::string refusalOf(const Eigen::Vector3d& place);
  [[nodiscard]] bool isJump(const Eigen::Vector3d& place);

  std::unique_ptr<FrameSource> source_;
  std::optional<Eigen::Vector3d> origin_;
  std::optional<Eigen::Vector3d> last_;       // of the last frame that was given
  std::optional<Eigen::Vector3d> elsewhere_;  // of the last one that jumped away from it
  int agreeing_ = 0;                          // frames with elsewhere_
};

}  // namespace scantrove
