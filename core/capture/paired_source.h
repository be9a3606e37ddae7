#pragma once
#include <memory>
#include <optional>

#include "core/base/result.h"
#include "core/capture/color_camera.h"
#include "core/capture/depth_color_streams.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Configuration of a PairedSource.
struct PairedSourceSetup {
  SourceInfo info;
  Result<std::optional<ColorCamera>> color_camera;  ///< error: colour cannot be used
  double meters_per_unit = 1e-3;
  int available = 0;  ///< depth frames of a recording; 0: live, or unknown
};

/// Pairs every depth image of two streams with the colour image nearest in time. With a camera, next() waits
/// a second at most (timeout); a camera that no longer responds is `failed`. A recording that sends nothing
/// for two seconds has ended.
class PairedSource final : public FrameSource {
 public:
  /// `options`: start, stride and, of a recording, frames select the frames.
  PairedSource(std::unique_ptr<DepthColorStreams> streams, PairedSourceSetup setup,
               const SourceOptions& options);

  [[nodiscard]] const SourceInfo& info() const override { return setup_.info; }
  [[nodiscard]] FrameRead next() override;

 private:
  [[nodiscard]] bool isSelected(int index);
  [[nodiscard]] bool isOver() const;
  FrameRead readOne();
  [[nodiscard]] bool hasColorFor(const StreamImage& depth) const;
  FrameRead makeFrame(const StreamImage& depth);
  [[nodiscard]] cv::Mat colorFor(const StreamImage& depth) const;
  [[nodiscard]] FrameRead nothingInTime() const;
  [[nodiscard]] FrameRead gone(const std::string& reason) const;

  std::unique_ptr<DepthColorStreams> streams_;
  PairedSourceSetup setup_;
  SourceOptions options_;
  int next_index_ = 0;
  int given_ = 0;
  int without_color_ = 0;  // depth images discarded for lack of a colour image
  std::optional<StreamImage> depth_, color_, older_color_;
};

}  // namespace scantrove
