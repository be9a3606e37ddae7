#include "core/capture/openni_source.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <utility>

#include "core/capture/camera_intrinsics.h"
#include "core/capture/cameras.h"
#include "core/capture/color_registration.h"
#include "core/capture/depth_plausibility.h"
#include "core/capture/oni_file.h"
#include "core/capture/openni_streams.h"
#include "core/capture/source_options.h"

namespace scantrove {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using Status = FrameRead::Status;

constexpr auto kLiveTimeout = 1000ms;
constexpr auto kRecordingTimeout = 2000ms;  // a recording that gives nothing for so long is over
constexpr double kColorLag_s = 0.020;       // a little more than half a frame at 30 Hz

class OpenNiSource final : public FrameSource {
 public:
  OpenNiSource(std::unique_ptr<OpenNiStreams> streams, SourceInfo info,
               Result<std::optional<ColorCamera>> color_camera, double metres_per_unit,
               const SourceOptions& options, int available)
      : streams_(std::move(streams)),
        info_(std::move(info)),
        color_camera_(std::move(color_camera)),
        metres_per_unit_(metres_per_unit),
        options_(options),
        available_(available) {}

  const SourceInfo& info() const override { return info_; }

  FrameRead next() override {
    while (true) {
      FrameRead read = readOne();
      if (read.status != Status::frame || isSelected(read.frame.index)) {
        return read;
      }
    }
  }

 private:
  bool isSelected(int index) {
    if (index < options_.start || (index - options_.start) % options_.stride != 0) {
      return false;
    }
    ++given_;
    return true;
  }

  [[nodiscard]] bool isOver() const {
    // ReadAhead ends a live camera, by the frames that were taken from it.
    const bool enough = !info_.is_live && options_.frames && given_ >= *options_.frames;
    return enough || (available_ > 0 && next_index_ >= available_);
  }

  FrameRead readOne() {
    FrameRead read;
    if (isOver()) {
      return read;
    }
    const Clock::time_point deadline = Clock::now() + (info_.is_live ? kLiveTimeout : kRecordingTimeout);
    while (true) {
      if (depth_ && hasColorFor(*depth_)) {
        return makeFrame(*std::exchange(depth_, std::nullopt));
      }
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
      auto arrival = streams_->wait(std::max(left, 1ms));
      if (!arrival) {
        return gone(arrival.error().what);
      }
      const bool is_late = !arrival->depth && !arrival->color && left <= 0ms;
      if (arrival->color) {
        older_color_ = std::move(color_);
        color_ = std::move(arrival->color);
      }
      // Two clocks may drift apart, or colour be late: depth that was followed by the next, or by nothing,
      // takes the colour there is.
      if (depth_ && color_ && (arrival->depth || is_late)) {
        return makeFrame(*std::exchange(depth_, std::move(arrival->depth)));
      }
      if (is_late) {
        return nothingInTime();
      }
      if (arrival->depth) {
        depth_ = std::move(arrival->depth);
      }
    }
  }

  /// A colour image of the same moment is here, or one that is later (none that fits better can follow).
  [[nodiscard]] bool hasColorFor(const OpenNiImage& depth) const {
    return !streams_->hasColor() || (color_ && color_->timestamp_s >= depth.timestamp_s - kColorLag_s);
  }

  FrameRead makeFrame(const OpenNiImage& depth) {
    FrameRead read;
    read.frame.index = next_index_++;
    if (depth.image.size() != cv::Size(info_.intrinsics.width, info_.intrinsics.height)) {
      read.status = Status::skipped;
      read.error = {"Frame " + std::to_string(read.frame.index) + " of " + info_.name + " is damaged.", ""};
      return read;
    }
    read.status = Status::frame;
    read.frame.timestamp_s = depth.timestamp_s;
    read.frame.metres_per_unit = static_cast<float>(metres_per_unit_);
    read.frame.depth = depth.image;
    if (color_camera_) {
      read.frame.color = colorFor(depth);
      read.frame.color_camera = *color_camera_;
    }
    if (!info_.is_live && read.frame.index == options_.start) {
      warnOfImplausibleDepth(read.frame.depth, metres_per_unit_, info_.name);
    }
    return read;
  }

  /// The nearer of the last two; empty if there is none, or it is damaged.
  [[nodiscard]] cv::Mat colorFor(const OpenNiImage& depth) const {
    const auto distance = [&](const std::optional<OpenNiImage>& color) {
      return color ? std::abs(color->timestamp_s - depth.timestamp_s) : INFINITY;
    };
    if (!color_) {
      return {};
    }
    const cv::Mat& color = (distance(older_color_) < distance(color_) ? older_color_ : color_)->image;
    return color.size() == streams_->colorSize() ? color : cv::Mat();
  }

  FrameRead nothingInTime() {
    FrameRead read;
    read.status = info_.is_live ? Status::timeout : Status::end;
    if (!info_.is_live && available_ > next_index_) {
      spdlog::warn("{}: ended after {} of {} frames.", info_.name, next_index_, available_);
    }
    return read;
  }

  [[nodiscard]] FrameRead gone(const std::string& reason) const {
    FrameRead read;
    read.status = Status::failed;
    read.error = {info_.name + " does not answer any more: " + reason + ".",
                  info_.is_live ? "Was the camera unplugged? Plug it in and open it again." : ""};
    return read;
  }

  std::unique_ptr<OpenNiStreams> streams_;
  SourceInfo info_;
  Result<std::optional<ColorCamera>> color_camera_;  // error: colour is of no use
  double metres_per_unit_;
  SourceOptions options_;
  int available_;  // depth frames of a recording; 0: live, or unknown
  int next_index_ = 0;
  int given_ = 0;
  std::optional<OpenNiImage> depth_, color_, older_color_;
};

Result<std::unique_ptr<FrameSource>> makeSource(std::unique_ptr<OpenNiStreams> streams,
                                                const std::string& name, const SourceOptions& options) {
  SourceInfo info;
  info.name = name;
  info.is_live = !streams->isRecording();
  info.kind = info.is_live ? "OpenNI2 camera" : "OpenNI2 recording";
  const cv::Size size = streams->size();
  if (options.intrinsics) {
    info.intrinsics = *options.intrinsics;
    info.intrinsics.width = size.width;
    info.intrinsics.height = size.height;
  } else if (const auto K = streams->intrinsics()) {
    info.intrinsics = *K;
  } else {
    info.intrinsics = kPrimeSenseIntrinsics.resizedTo(size.width, size.height);
    spdlog::warn(
        "{} does not say its field of view; using 525,525,319.5,239.5 at 640x480. Give the right intrinsics "
        "with "
        "--intrinsics fx,fy,cx,cy.",
        name);
  }
  SCANTROVE_TRY(
      checkIntrinsics(info.intrinsics, options.intrinsics ? "--intrinsics" : "field of view of " + name));
  const int available = streams->depthFrameCount();
  if (available > 0) {
    const auto selected = selectFrames(static_cast<std::size_t>(available), options, name);
    if (!selected) {
      return fail(selected.error());
    }
    info.frame_count = static_cast<int>(selected->size());
  }
  const double metres_per_unit = options.depth_scale ? 1.0 / *options.depth_scale : streams->metresPerUnit();
  Result<std::optional<ColorCamera>> color_camera;
  if (streams->hasColor()) {
    const ColorRegistration color = options.color_registration.value_or(ColorRegistration{});
    color_camera = colorCameraFor(color, streams->colorSize(), info.intrinsics, name);
    if (!color_camera && options.color_registration) return fail(color_camera.error());
    if (!color_camera) spdlog::warn("{} Going on without colour.", color_camera.error().message());
  }
  return std::make_unique<OpenNiSource>(std::move(streams), std::move(info), std::move(color_camera),
                                        metres_per_unit, options, available);
}

}  // namespace

Result<std::unique_ptr<FrameSource>> openCamera(const std::string& uri, const SourceOptions& options) {
  std::string chosen = uri;
  if (chosen.empty()) {
    const auto cameras = listCameras();
    if (!cameras) {
      return fail(cameras.error());
    }
    if (cameras->empty()) {
      return fail("No depth camera was found.", cameraAdvice());
    }
    chosen = cameras->front().uri;
  }
  if (std::error_code error;
      std::filesystem::exists(chosen, error)) {  // OpenNI2 takes a file's path for a URI
    SCANTROVE_TRY(checkOniFile(chosen));
  }
  auto streams = std::make_unique<OpenNiStreams>();
  const bool is_to_register = !options.color_registration || !options.color_registration->camera;
  if (const auto opened = streams->open(chosen, is_to_register); !opened) {
    return fail(opened.error().what, opened.error().advice.empty() ? cameraAdvice() : opened.error().advice);
  }
  const std::string name = streams->name();
  return makeSource(std::move(streams), name.empty() ? chosen : name, options);
}

Result<std::unique_ptr<FrameSource>> openOniRecording(const std::filesystem::path& file,
                                                      const SourceOptions& options) {
  SCANTROVE_TRY(checkOniFile(file));
  auto streams = std::make_unique<OpenNiStreams>();
  if (const auto opened = streams->open(file.string(), true); !opened) {
    return fail(opened.error().what, opened.error().advice.empty()
                                         ? "Is the file a complete OpenNI recording?"
                                         : opened.error().advice);
  }
  return makeSource(std::move(streams), file.filename().string(), options);
}

}  // namespace scantrove
