#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <opencv2/core/types.hpp>
#include <string>
#include <utility>

#include "core/base/result.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// A live camera that may be lost: unplugged, switched off, without frames for some seconds. It is then
/// opened again every second, and frames go on when it returns. Numbers and times of frames continue; frames
/// of another resolution are changed to that of the first ones. While it is lost, next() returns `timeout`
/// with an error that says so. One thread.
class ReconnectingSource final : public FrameSource {
 public:
  using Open = std::function<Result<std::unique_ptr<FrameSource>>()>;
  struct Patience {
    std::chrono::milliseconds stall{5000};      ///< without a usable frame: the camera is lost
    std::chrono::milliseconds retry{1000};      ///< between two attempts to open it; next() waits as long
    std::chrono::milliseconds give_up{600000};  ///< then next() returns `end` with an error
  };

  /// `source` is open; `reopen` opens the same camera again.
  ReconnectingSource(std::unique_ptr<FrameSource> source, Open reopen, Patience patience);
  ReconnectingSource(std::unique_ptr<FrameSource> source, Open reopen)
      : ReconnectingSource(std::move(source), std::move(reopen), Patience{}) {}

  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] FrameRead next() override;

 private:
  using Clock = std::chrono::steady_clock;

  [[nodiscard]] FrameRead nextOfCamera();
  [[nodiscard]] FrameRead usable(FrameRead read);
  /// Error: the frame's size is not that of a known camera.
  [[nodiscard]] Result<void> adapt(RgbdFrame& frame) const;
  [[nodiscard]] FrameRead lose(const std::string& reason);
  [[nodiscard]] FrameRead nextOfLostCamera();
  /// Error: it cannot be opened, or it is another camera.
  [[nodiscard]] Result<void> open();
  [[nodiscard]] FrameRead lost() const;

  SourceInfo info_;  // of the first opening
  Open reopen_;
  Patience patience_;
  std::unique_ptr<FrameSource> source_;  // null: lost
  Intrinsics own_;                       // of the present opening
  cv::Size color_size_;                  // of the first colour image
  int last_index_ = 0;                   // of the last usable frame
  double last_time_s_ = 0;
  bool has_frames_ = false;
  Clock::duration waited_{};  // in the camera's next(), since the last usable frame
  Clock::time_point lost_since_, next_try_;
  bool is_waiting_ = false;  // lost, and no usable frame since
  std::string reason_;       // why it is lost, or why it cannot be used again
};

}  // namespace scantrove
