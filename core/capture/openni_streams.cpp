#include "core/capture/openni_streams.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <thread>

#include "core/capture/openni_library.h"

namespace scantrove {

namespace {

constexpr std::string_view kVirtualCamera = "Dummy";
constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kFramesPerSecond = 30;

/// Sets 640x480 at 30 Hz in `format` if the sensor offers it; otherwise keeps the sensor's mode.
void chooseMode(openni::VideoStream& stream, openni::PixelFormat format) {
  const openni::Array<openni::VideoMode>& modes = stream.getSensorInfo().getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    const openni::VideoMode& mode = modes[i];
    if (mode.getResolutionX() == kWidth && mode.getResolutionY() == kHeight &&
        mode.getFps() == kFramesPerSecond && mode.getPixelFormat() == format) {
      stream.setVideoMode(mode);
      return;
    }
  }
}

/// Empty if the frame's data is shorter than its size requires (a damaged recording).
cv::Mat viewOf(const openni::VideoFrameRef& frame, int type) {
  const std::int64_t stride = frame.getStrideInBytes();
  const bool is_complete = frame.getWidth() > 0 && frame.getHeight() > 0 &&
                           stride >= std::int64_t{CV_ELEM_SIZE(type)} * frame.getWidth() &&
                           stride * frame.getHeight() <= frame.getDataSize();
  if (!is_complete) {
    return {};
  }
  return {frame.getHeight(), frame.getWidth(), type, const_cast<void*>(frame.getData()),
          static_cast<std::size_t>(frame.getStrideInBytes())};
}

/// Converts to BGR; empty if the image is.
cv::Mat toBgr(const cv::Mat& image, int conversion) {
  cv::Mat bgr;
  if (!image.empty()) {
    cv::cvtColor(image, bgr, conversion);
  }
  return bgr;
}

/// Empty if the format is unknown.
cv::Mat copyColor(const openni::VideoFrameRef& frame) {
  switch (frame.getVideoMode().getPixelFormat()) {
    case openni::PIXEL_FORMAT_RGB888:
      return toBgr(viewOf(frame, CV_8UC3), cv::COLOR_RGB2BGR);
    case openni::PIXEL_FORMAT_YUV422:
      return toBgr(viewOf(frame, CV_8UC2), cv::COLOR_YUV2BGR_UYVY);
    case openni::PIXEL_FORMAT_YUYV:
      return toBgr(viewOf(frame, CV_8UC2), cv::COLOR_YUV2BGR_YUYV);
    case openni::PIXEL_FORMAT_GRAY8:
      return toBgr(viewOf(frame, CV_8UC1), cv::COLOR_GRAY2BGR);
    default:
      return {};
  }
}

void unmirror(cv::Mat& image, bool is_mirrored) {
  if (is_mirrored && !image.empty()) {
    cv::flip(image, image, 1);
  }
}

cv::Size sizeOf(const openni::VideoStream& stream) {
  const openni::VideoMode mode = stream.getVideoMode();
  return {mode.getResolutionX(), mode.getResolutionY()};
}

double seconds(const openni::VideoFrameRef& frame) {
  return static_cast<double>(frame.getTimestamp()) * 1e-6;
}

}  // namespace

OpenNiStreams::~OpenNiStreams() {
  const bool is_open = handles_->device.isValid();
  const bool is_virtual = is_open && handles_->device.getDeviceInfo().getUri() == kVirtualCamera;
  for (openni::VideoStream* const stream : {&handles_->depth, &handles_->color}) {
    if (stream->isValid()) {
      stream->stop();
    }
  }
  if (is_virtual || (is_open && isRecording())) {
    // The virtual camera's threads sleep for a frame's time and then use the stream even if it was stopped or
    // destroyed. A recording's thread walks the list of streams without a lock: continuously at the end of
    // the file, occasionally after a stop. The delay lets these threads become idle.
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  if (is_virtual) {
    // The delay does not always suffice, so its streams stay alive until the process ends.
    static std::mutex mutex;
    static Handles* kept = nullptr;  // never destroyed
    const std::scoped_lock lock(mutex);
    handles_->kept_before = kept;
    kept = handles_.release();
    return;
  }
  handles_->depth.destroy();
  handles_->color.destroy();
  handles_->device.close();
}

Result<void> OpenNiStreams::open(const std::string& uri, bool is_to_register) {
  SCANTROVE_TRY(initializeOpenNi());
  if (handles_->device.open(uri.c_str()) != openni::STATUS_OK) {
    return fail("OpenNI2 cannot open " + uri + ": " + openNiError() + ".");
  }
  if (handles_->device.getSensorInfo(openni::SENSOR_DEPTH) == nullptr ||
      handles_->depth.create(handles_->device, openni::SENSOR_DEPTH) != openni::STATUS_OK) {
    return fail(uri + " has no depth stream.",
                "Scantrove needs depth; is this a colour-only camera or recording?");
  }
  if (handles_->device.getSensorInfo(openni::SENSOR_COLOR) == nullptr ||
      handles_->color.create(handles_->device, openni::SENSOR_COLOR) != openni::STATUS_OK) {
    spdlog::warn("{} has no colour stream: depth only.", uri);
  }
  if (isRecording()) {
    // A file stores images as recorded; setting the property would not mirror them.
    is_depth_mirrored_ = handles_->depth.getMirroringEnabled();
    is_color_mirrored_ = hasColor() && handles_->color.getMirroringEnabled();
    handles_->device.getPlaybackControl()->setRepeatEnabled(false);
    handles_->device.getPlaybackControl()->setSpeed(-1.0F);  // without pacing
  } else {
    configureCamera(is_to_register);
  }
  if (handles_->depth.start() != openni::STATUS_OK ||
      (hasColor() && handles_->color.start() != openni::STATUS_OK)) {
    return fail("OpenNI2 cannot start the streams of " + uri + ": " + openNiError() + ".",
                "Is another program using the camera?");
  }
  const openni::PixelFormat format = handles_->depth.getVideoMode().getPixelFormat();
  if (format != openni::PIXEL_FORMAT_DEPTH_1_MM && format != openni::PIXEL_FORMAT_DEPTH_100_UM) {
    return fail(uri + " gives depth in OpenNI2's format " + std::to_string(format) + ".",
                "Scantrove reads depth in 1 mm or 100 um steps.");
  }
  return {};
}

void OpenNiStreams::configureCamera(bool is_to_register) {
  chooseMode(handles_->depth, openni::PIXEL_FORMAT_DEPTH_1_MM);
  handles_->depth.setMirroringEnabled(false);
  if (!hasColor()) {
    return;
  }
  chooseMode(handles_->color, openni::PIXEL_FORMAT_RGB888);
  handles_->color.setMirroringEnabled(false);
  const auto mode =
      is_to_register ? openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR : openni::IMAGE_REGISTRATION_OFF;
  if (handles_->device.isImageRegistrationModeSupported(mode)) {
    handles_->device.setImageRegistrationMode(mode);
  }
  handles_->device.setDepthColorSyncEnabled(true);  // if unsupported, frames are still paired by time
}

int OpenNiStreams::depthFrameCount() {
  openni::PlaybackControl* const playback = handles_->device.getPlaybackControl();
  return playback == nullptr ? 0 : std::max(0, playback->getNumberOfFrames(handles_->depth));
}

double OpenNiStreams::metersPerUnit() const {
  return handles_->depth.getVideoMode().getPixelFormat() == openni::PIXEL_FORMAT_DEPTH_100_UM ? 1e-4 : 1e-3;
}

cv::Size OpenNiStreams::size() const { return sizeOf(handles_->depth); }

cv::Size OpenNiStreams::colorSize() const { return sizeOf(handles_->color); }

std::optional<Intrinsics> OpenNiStreams::intrinsics() const {
  const auto width = static_cast<float>(size().width);
  const auto height = static_cast<float>(size().height);
  const float horizontal = handles_->depth.getHorizontalFieldOfView();
  const float vertical = handles_->depth.getVerticalFieldOfView();
  const auto isAngle = [](float angle) { return angle > 0.1F && angle < 3.0F; };
  if (!isAngle(horizontal) || !isAngle(vertical)) {
    return std::nullopt;
  }
  return Intrinsics{width / (2 * std::tan(horizontal / 2)),
                    height / (2 * std::tan(vertical / 2)),
                    (width - 1) / 2,
                    (height - 1) / 2,
                    size().width,
                    size().height};
}

Result<OpenNiStreams::Arrival> OpenNiStreams::wait(std::chrono::milliseconds timeout) {
  openni::VideoStream* streams[] = {&handles_->depth, &handles_->color};
  int ready = -1;
  const openni::Status status = openni::OpenNI::waitForAnyStream(streams, hasColor() ? 2 : 1, &ready,
                                                                 static_cast<int>(timeout.count()));
  if (status == openni::STATUS_TIME_OUT) {
    return Arrival{};
  }
  openni::VideoFrameRef frame;
  if (status != openni::STATUS_OK || streams[ready]->readFrame(&frame) != openni::STATUS_OK ||
      !frame.isValid()) {
    return fail(openNiError());
  }
  Arrival arrival;
  if (ready == 0) {
    arrival.depth = StreamImage{viewOf(frame, CV_16UC1).clone(), seconds(frame)};
    unmirror(arrival.depth->image, is_depth_mirrored_);
  } else {
    arrival.color = StreamImage{copyColor(frame), seconds(frame)};
    unmirror(arrival.color->image, is_color_mirrored_);
  }
  return arrival;
}

}  // namespace scantrove
