#include "core/capture/continued_source.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

namespace scantrove {
namespace {

/// Time between two recordings: one frame at 30 Hz.
constexpr double kBetweenFrames_s = 1.0 / 30;

int orLargest(std::int64_t index) {
  constexpr std::int64_t kLargest = std::numeric_limits<int>::max();
  return static_cast<int>(std::clamp<std::int64_t>(index, 0, kLargest));
}

}  // namespace

std::optional<FrameRead> ContinuedSource::nextIfReady() {
  std::optional<FrameRead> read = source_->nextIfReady();
  if (!read) return read;
  return shifted(std::move(*read));
}

FrameRead ContinuedSource::shifted(FrameRead read) {
  if (read.status != FrameRead::Status::frame && read.status != FrameRead::Status::skipped) return read;
  RgbdFrame& frame = read.frame;
  if (!shift_ && read.status == FrameRead::Status::frame) {
    shift_ = Shift{};
    if (frame.index <= last_index_) shift_->index = orLargest(std::int64_t{last_index_} + 1 - frame.index);
    if (!(frame.timestamp_s > last_time_s_))
      shift_->time_s = last_time_s_ + kBetweenFrames_s - frame.timestamp_s;
  }
  frame.index = orLargest(std::int64_t{frame.index} + shift().index);
  frame.timestamp_s += shift().time_s;
  if (!frame.intrinsics) frame.intrinsics = intrinsics_;
  return read;
}

}  // namespace scantrove
