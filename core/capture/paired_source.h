#pragma once
#include <memory>
#include <optional>

#include "core/base/result.h"
#include "core/capture/color_camera.h"
#include "core/capture/depth_color_streams.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// What a PairedSource makes of the images that it gets.
struct PairedSourceSetup {
  SourceInfo info;
  Result<std::optional<ColorCamera>> color_camera;  ///< error: colour is of no use
  double meters_per_unit = 1e-3;
  int available = 0;  ///< depth frames of a recording; 0: live, or unknown
};

/// Frames from two streams: every depth image with the colour image nearest to it in time. Of a camera next()
/// waits a second at most (timeout), and one that does not answer any more is `failed`; a recording that
/// gives nothing for two seconds is over.
class PairedSource final : public FrameSource {
 public:
  /// start, stride and, of a recording, frames of `options` choose the frames.
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
  int without_color_ = 0;  // depth images given up because no colour had come
  std::optional<StreamImage> depth_, color_, older_color_;
};

}  // namespace scantrove
