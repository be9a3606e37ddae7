#pragma once
#include <functional>
#include <memory>

#include "core/base/result.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// A recording that is read several times in a row, as one long recording: numbers and times of frames go
/// on. The first frame of each repetition is marked as FrameRead::is_reconnected, because the camera is
/// elsewhere. For tests of endurance. One thread.
class LoopedSource final : public FrameSource {
 public:
  using Open = std::function<Result<std::unique_ptr<FrameSource>>()>;

  /// `source` is open; `reopen` opens the recording again, `loops` - 1 times.
  LoopedSource(std::unique_ptr<FrameSource> source, Open reopen, int loops);

  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] FrameRead next() override;

 private:
  [[nodiscard]] Result<void> beginAgain();

  std::unique_ptr<FrameSource> source_;
  SourceInfo info_;  // with the frames of all repetitions
  Open reopen_;
  int left_;            // repetitions to come
  int last_index_ = 0;  // of the last frame
  double last_time_s_ = 0;
  bool has_frames_ = false;    // in the present repetition
  bool is_beginning_ = false;  // no frame of the present repetition was returned, and it is not the first
};

}  // namespace scantrove
