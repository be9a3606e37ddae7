#include "core/capture/looped_source.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/capture/continued_source.h"
#include "core/capture/no_frames.h"

namespace scantrove {

LoopedSource::LoopedSource(std::unique_ptr<FrameSource> source, Open reopen, int loops)
    : source_(std::move(source)), info_(source_->info()), reopen_(std::move(reopen)), left_(loops - 1) {
  if (!info_.frame_count) return;
  constexpr std::int64_t kLargest = std::numeric_limits<int>::max();
  info_.frame_count = static_cast<int>(std::min(std::int64_t{*info_.frame_count} * loops, kLargest));
}

FrameRead LoopedSource::next() {
  while (true) {
    FrameRead read = source_->next();
    if (read.status == FrameRead::Status::end && left_ > 0 && has_frames_) {
      const Result<void> again = beginAgain();
      if (again) continue;
      read.status = FrameRead::Status::failed;
      read.error = again.error();
      return read;
    }
    if (read.status != FrameRead::Status::frame) return read;
    last_index_ = read.frame.index;
    last_time_s_ = read.frame.timestamp_s;
    has_frames_ = true;
    read.is_reconnected = std::exchange(is_beginning_, false);
    return read;
  }
}

Result<void> LoopedSource::beginAgain() {
  --left_;
  source_.reset();
  Result<std::unique_ptr<FrameSource>> opened = reopen_();
  if (!opened) {
    source_ = std::make_unique<NoFrames>(info_);
    return fail(opened.error());
  }
  source_ = std::make_unique<ContinuedSource>(std::move(*opened), last_index_, last_time_s_);
  has_frames_ = false;
  is_beginning_ = true;
  return {};
}

}  // namespace scantrove
