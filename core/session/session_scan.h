#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/capture/rgbd_frame.h"
#include "core/dataset/labeled_scan.h"
#include "core/session/open_session.h"

namespace scantrove {

/// A session as the source of data sets. The thread of the session, which outlives this.
class SessionScan final : public LabeledScan {
 public:
  explicit SessionScan(OpenSession& session);

  /// Cameras and poses of a key frame, with the number of its frame in the source.
  [[nodiscard]] static KeyFrameInfo infoOf(const OpenSession& session, const SavedKeyFrame& images,
                                           const SavedFrame& frame);
  /// The stored images of the frame with that external number; null: none were kept.
  [[nodiscard]] const SavedKeyFrame* keyFrameOf(int index) const;

  [[nodiscard]] std::string name() const override;
  [[nodiscard]] Eigen::Vector3d origin() const override { return session_.setup().origin_m; }
  [[nodiscard]] Result<std::vector<LabeledRegion>> regions() override;
  [[nodiscard]] std::vector<ObjectClass> classes() override;
  [[nodiscard]] Result<std::vector<KeyFrameInfo>> keyFrames(bool all_frames) override;
  [[nodiscard]] Result<cv::Mat> color(int index) override;
  [[nodiscard]] Result<cv::Mat> depth(int index) override;
  [[nodiscard]] std::vector<PaintedMask> paintedMasks(int index) override;
  [[nodiscard]] Result<ViewOfMap> renderView(const Intrinsics& K,
                                             const Eigen::Isometry3d& T_world_camera) override;
  [[nodiscard]] Result<LabeledMesh> mesh() override;
  [[nodiscard]] Result<void> forEachPoint(const std::function<void(const SurfacePoint&)>& give) override;
  [[nodiscard]] Result<Trajectory> trajectory() override;

 private:
  /// A frame with stored images, and its external number.
  struct StoredFrame {
    int index;
    const SavedKeyFrame* images;
    const SavedFrame* frame;
  };
  [[nodiscard]] Result<RgbdFrame> read(int index);
  [[nodiscard]] std::uint32_t regionOf(std::uint32_t fragment) const;

  OpenSession& session_;
  std::vector<StoredFrame> stored_;  // with a pose, in order
  std::optional<std::pair<int, RgbdFrame>>
      last_read_;  // by its external number: colour and depth are requested apart
};

}  // namespace scantrove
