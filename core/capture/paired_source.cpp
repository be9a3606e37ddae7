#include "core/capture/paired_source.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "core/capture/depth_plausibility.h"

namespace scantrove {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Status = FrameRead::Status;

constexpr auto kLiveTimeout = 1000ms;
constexpr auto kRecordingTimeout = 2000ms;  // a recording that sends nothing for this long has ended
constexpr double kColorLag_s = 0.020;       // slightly more than half a frame at 30 Hz
constexpr int kMaxWithoutColor = 30;        // depth images that wait for the first colour image: one second

}  // namespace

PairedSource::PairedSource(std::unique_ptr<DepthColorStreams> streams, PairedSourceSetup setup,
                           const SourceOptions& options)
    : streams_(std::move(streams)), setup_(std::move(setup)), options_(options) {}

FrameRead PairedSource::next() {
  while (true) {
    FrameRead read = readOne();
    if (read.status != Status::frame || isSelected(read.frame.index)) {
      return read;
    }
  }
}

bool PairedSource::isSelected(int index) {
  if (index < options_.start || (index - options_.start) % options_.stride != 0) {
    return false;
  }
  ++given_;
  return true;
}

bool PairedSource::isOver() const {
  // ReadAhead limits live cameras, counting the frames taken.
  const bool enough = !setup_.info.is_live && options_.frames && given_ >= *options_.frames;
  return enough || (setup_.available > 0 && next_index_ >= setup_.available);
}

FrameRead PairedSource::readOne() {
  FrameRead read;
  if (isOver()) {
    return read;
  }
  const Clock::time_point deadline = Clock::now() + (setup_.info.is_live ? kLiveTimeout : kRecordingTimeout);
  while (true) {
    if (depth_ && hasColorFor(*depth_)) {
      return makeFrame(*std::exchange(depth_, std::nullopt));
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
    auto arrival = streams_->wait(std::max(left, 1ms));
    if (!arrival) {
      return gone(arrival.error().what);
    }
    const bool is_late = !arrival->depth && !arrival->color;
    if (arrival->color) {
      older_color_ = std::move(color_);
      color_ = std::move(arrival->color);
    }
    // Two clocks may drift apart, or colour may be late. Depth that was followed by the next depth image, or
    // by nothing, takes the available colour image.
    if (depth_ && color_ && (arrival->depth || is_late)) {
      return makeFrame(*std::exchange(depth_, std::move(arrival->depth)));
    }
    if (is_late) {
      return nothingInTime();
    }
    if (arrival->depth) {
      without_color_ += depth_ ? 1 : 0;
      depth_ = std::move(arrival->depth);
    }
  }
}

/// Whether a colour image of the same moment or a later one has arrived (no better match can follow), or none
/// is expected.
bool PairedSource::hasColorFor(const StreamImage& depth) const {
  if (!color_) {
    return !streams_->hasColor() || without_color_ >= kMaxWithoutColor;
  }
  return color_->timestamp_s >= depth.timestamp_s - kColorLag_s;
}

FrameRead PairedSource::makeFrame(const StreamImage& depth) {
  FrameRead read;
  read.frame.index = next_index_++;
  if (depth.image.size() != cv::Size(setup_.info.intrinsics.width, setup_.info.intrinsics.height)) {
    read.status = Status::skipped;
    read.error = {"Frame " + std::to_string(read.frame.index) + " of " + setup_.info.name + " is damaged.",
                  ""};
    return read;
  }
  read.status = Status::frame;
  read.frame.timestamp_s = depth.timestamp_s;
  read.frame.meters_per_unit = static_cast<float>(setup_.meters_per_unit);
  read.frame.depth = depth.image;
  if (setup_.color_camera) {
    read.frame.color = colorFor(depth);
    read.frame.color_camera = *setup_.color_camera;
  }
  if (!setup_.info.is_live && read.frame.index == options_.start) {
    warnOfImplausibleDepth(read.frame.depth, 1.0 / setup_.meters_per_unit, setup_.info.name);
  }
  return read;
}

/// The nearer of the last two colour images; empty if there is none, or it is damaged.
cv::Mat PairedSource::colorFor(const StreamImage& depth) const {
  const auto distance = [&](const std::optional<StreamImage>& color) {
    return color ? std::abs(color->timestamp_s - depth.timestamp_s) : INFINITY;
  };
  if (!color_) {
    return {};
  }
  const cv::Mat& color = (distance(older_color_) < distance(color_) ? older_color_ : color_)->image;
  return color.size() == streams_->colorSize() ? color : cv::Mat();
}

FrameRead PairedSource::nothingInTime() const {
  FrameRead read;
  read.status = setup_.info.is_live ? Status::timeout : Status::end;
  if (!setup_.info.is_live && setup_.available > next_index_) {
    spdlog::warn("{}: ended after {} of {} frames.", setup_.info.name, next_index_, setup_.available);
  }
  return read;
}

FrameRead PairedSource::gone(const std::string& reason) const {
  FrameRead read;
  read.status = Status::failed;
  read.error = {setup_.info.name + " does not answer any more: " + reason + ".",
                setup_.info.is_live ? "Was the camera unplugged? Plug it in and open it again." : ""};
  return read;
}

}  // namespace scantrove
