#include "core/capture/reconnecting_source.h"

#include <thread>
#include <utility>

#include "core/capture/adapted_frame.h"
#include "core/capture/continued_source.h"

namespace scantrove {
namespace {

std::string pixelSizeText(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

bool hasSizeOf(const cv::Mat& image, const Intrinsics& K) {
  return image.cols == K.width && image.rows == K.height;
}

}  // namespace

ReconnectingSource::ReconnectingSource(std::unique_ptr<FrameSource> source, Open reopen, Patience patience)
    : info_(source->info()),
      reopen_(std::move(reopen)),
      patience_(patience),
      source_(std::move(source)),
      own_(info_.intrinsics) {}

FrameRead ReconnectingSource::next() { return source_ ? nextOfCamera() : nextOfLostCamera(); }

FrameRead ReconnectingSource::nextOfCamera() {
  const Clock::time_point start = Clock::now();
  FrameRead read = source_->next();
  waited_ += Clock::now() - start;
  if (read.status == FrameRead::Status::failed) return lose(read.error.what);
  if (read.status == FrameRead::Status::frame) read = usable(std::move(read));
  if (read.status == FrameRead::Status::frame || read.status == FrameRead::Status::end) return read;
  // Damaged images alone are as good as none: a camera that is opened again may recover.
  if (waited_ < patience_.stall)
    return read.status == FrameRead::Status::timeout && is_waiting_ ? lost() : read;
  return lose(read.error.what.empty() ? info_.name + " sends no frames." : read.error.what);
}

FrameRead ReconnectingSource::usable(FrameRead read) {
  RgbdFrame& frame = read.frame;
  if (const Result<void> adapted = adapt(frame); !adapted) {
    read.status = FrameRead::Status::skipped;
    read.error = adapted.error();
    return read;
  }
  if (color_size_.empty()) color_size_ = frame.color.size();
  waited_ = {};
  last_index_ = frame.index;
  last_time_s_ = frame.timestamp_s;
  has_frames_ = true;
  read.is_reconnected = std::exchange(is_waiting_, false);
  return read;
}

Result<void> ReconnectingSource::adapt(RgbdFrame& frame) const {
  const Intrinsics& wanted = info_.intrinsics;
  const Intrinsics own = frame.intrinsics.value_or(own_);
  if (!hasSizeOf(frame.depth, own)) {
    return fail(
        info_.name + " sends depth images of " + pixelSizeText(frame.depth.cols, frame.depth.rows) +
            " pixels, whose intrinsics are not known.",
        "Set the camera to " + pixelSizeText(wanted.width, wanted.height) + " again, or begin a new scan.");
  }
  if (!hasSizeOf(frame.depth, wanted)) {
    adaptToCamera(frame, own, wanted, color_size_);
  } else if (!frame.intrinsics && own != wanted) {
    frame.intrinsics = own;
  }
  return {};
}

FrameRead ReconnectingSource::lose(const std::string& reason) {
  source_.reset();  // first: most cameras can be open once
  reason_ = reason;
  const Clock::time_point now = Clock::now();
  if (!std::exchange(is_waiting_, true)) lost_since_ = now;
  next_try_ = now + patience_.retry;
  return lost();
}

FrameRead ReconnectingSource::nextOfLostCamera() {
  if (Clock::now() - lost_since_ >= patience_.give_up) {
    FrameRead read;  // `end`
    read.error = {info_.name + " did not come back. " + reason_,
                  "The scan ends with its results; --resume or 'Continue scan' goes on later."};
    return read;
  }
  std::this_thread::sleep_until(next_try_);
  next_try_ = Clock::now() + patience_.retry;
  if (const Result<void> opened = open(); !opened) {
    reason_ = opened.error().what;
    return lost();
  }
  waited_ = {};
  return lost();  // until a frame comes
}

Result<void> ReconnectingSource::open() {
  Result<std::unique_ptr<FrameSource>> opened = reopen_();
  if (!opened) return fail(opened.error());
  const SourceInfo& info = (*opened)->info();
  if (info.kind != info_.kind) {
    return fail(info.name + " is another kind of camera than " + info_.name + ".",
                "Connect the camera of this scan.");
  }
  own_ = info.intrinsics;
  source_ = std::move(*opened);
  if (has_frames_) source_ = std::make_unique<ContinuedSource>(std::move(source_), last_index_, last_time_s_);
  return {};
}

FrameRead ReconnectingSource::lost() const {
  FrameRead read;
  read.status = FrameRead::Status::timeout;
  read.error = {"Camera lost: " + info_.name + ".", "Reconnect it; the scan goes on. (" + reason_ + ")"};
  return read;
}

}  // namespace scantrove
