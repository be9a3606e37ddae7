#include "core/capture/freenect_camera.h"

#include <sys/time.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string_view>

#include "core/capture/camera_intrinsics.h"

namespace scantrove {

namespace {

using std::chrono::microseconds;

/// Focal length of the depth camera from the constants of a Kinect v1's depth formula: zero plane at 120 mm,
/// pixels of 0.1042 mm, two per pixel of 640x480: 120 / (2 * 0.1042) pixels.
constexpr Intrinsics kDepthCamera{
    575.8F, 575.8F, 319.5F, 239.5F, FreenectCamera::kWidth, FreenectCamera::kHeight};

constexpr int kInterrupted = -10;  // LIBUSB_ERROR_INTERRUPTED: a signal, not a failure

// libfreenect logs and delivers images within its function calls, so this state belongs to the calling
// thread.
thread_local std::string first_message;
thread_local FreenectReceived* receiver = nullptr;

void keepFirstMessage(freenect_context*, freenect_loglevel, const char* message) {
  if (first_message.empty()) {
    first_message = message;
    first_message.erase(first_message.find_last_not_of(" .:(\n\r") + 1);  // "... stream 81 :("
  }
}

std::string reason() { return first_message.empty() ? "no reason given" : first_message; }

/// Exceptions must not pass through libfreenect: an image without memory for it is dropped.
template <class Convert>
void receive(bool is_depth, const void* data, std::uint32_t ticks, Convert convert) {
  if (receiver == nullptr || data == nullptr) {
    return;
  }
  try {
    receiver->images.push_back({is_depth, convert(data), ticks});
  } catch (const std::exception&) {
  }
}

cv::Mat imageAt(const void* data, int type) {
  return {FreenectCamera::kHeight, FreenectCamera::kWidth, type, const_cast<void*>(data)};
}

void receiveDepth(freenect_device*, void* data, std::uint32_t ticks) {
  receive(true, data, ticks, [](const void* pixels) {
    cv::Mat depth = imageAt(pixels, CV_16UC1).clone();
    // Unregistered depth reports "too far" as the largest value.
    depth.setTo(FREENECT_DEPTH_MM_NO_VALUE, depth >= FREENECT_DEPTH_MM_MAX_VALUE);
    return depth;
  });
}

void receiveColor(freenect_device*, void* data, std::uint32_t ticks) {
  receive(false, data, ticks, [](const void* pixels) {
    cv::Mat color;
    cv::cvtColor(imageAt(pixels, CV_8UC3), color, cv::COLOR_RGB2BGR);
    return color;
  });
}

/// Whether images of `mode` have the size that the callbacks read.
bool isAsExpected(const freenect_frame_mode& mode, int bytes_per_pixel) {
  return mode.is_valid != 0 && mode.width == FreenectCamera::kWidth &&
         mode.height == FreenectCamera::kHeight &&
         mode.bytes == bytes_per_pixel * FreenectCamera::kWidth * FreenectCamera::kHeight;
}

}  // namespace

std::string FreenectChoice::name() const {
  return "Kinect " + (serial.empty() ? std::to_string(index) : serial);
}

Result<std::unique_ptr<FreenectContext>> FreenectContext::create(const FreenectApi& api) {
  std::unique_ptr<FreenectContext> context(new FreenectContext(api));
  const int status = api.init(&context->context_, nullptr);
  if (status < 0 || context->context_ == nullptr) {
    context->context_ = nullptr;
    return fail("libfreenect cannot start (error " + std::to_string(status) + ").",
                "It needs USB: does `lsusb` list anything?");
  }
  api.set_log_level(context->context_, FREENECT_LOG_ERROR);
  api.set_log_callback(context->context_, keepFirstMessage);
  // The motor and microphones are unused, and some models need firmware for them that Debian lacks.
  api.select_subdevices(context->context_, FREENECT_DEVICE_CAMERA);
  return context;
}

FreenectContext::~FreenectContext() {
  if (context_ != nullptr) {
    api_.shutdown(context_);
  }
}

int FreenectContext::count() const { return std::max(0, api_.num_devices(context_)); }

Result<std::unique_ptr<FreenectCamera>> FreenectCamera::open(const FreenectApi& api,
                                                             const FreenectChoice& choice,
                                                             bool is_registered) {
  auto context = FreenectContext::create(api);
  if (!context) {
    return fail(context.error());
  }
  std::unique_ptr<FreenectCamera> camera(new FreenectCamera(std::move(*context), is_registered));
  SCANTROVE_TRY(camera->openDevice(choice));
  SCANTROVE_TRY(camera->start(choice.name()));
  return camera;
}

Result<void> FreenectCamera::openDevice(const FreenectChoice& choice) {
  const int count = context_->count();
  if (count == 0) {
    return fail(
        "No Kinect v1 was found.",
        "Plug it in, its power supply too: without it only its base answers. `scantrove devices` says "
        "what is plugged in.");
  }
  if (choice.serial.empty() && choice.index >= count) {
    return fail("There is no Kinect " + std::to_string(choice.index) + ": " +
                    (count == 1 ? "one is" : std::to_string(count) + " are") + " plugged in.",
                "They count from 0; see `scantrove devices`.");
  }
  first_message.clear();
  const int status = choice.serial.empty() ? api().open_device(context_->get(), &device_, choice.index)
                                           : api().open_device_by_camera_serial(context_->get(), &device_,
                                                                                choice.serial.c_str());
  if (status < 0 || device_ == nullptr) {
    device_ = nullptr;  // the context closes a half-open device
    return fail(
        choice.name() + " cannot be opened: " + reason() + ".",
        "Is another program using it, and may your user open it? `scantrove devices` says what helps.");
  }
  return {};
}

Result<void> FreenectCamera::start(const std::string& name) {
  const freenect_frame_mode depth = api().find_depth_mode(
      FREENECT_RESOLUTION_MEDIUM, is_registered_ ? FREENECT_DEPTH_REGISTERED : FREENECT_DEPTH_MM);
  const freenect_frame_mode color = api().find_video_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_VIDEO_RGB);
  if (!isAsExpected(depth, 2) || !isAsExpected(color, 3)) {
    return fail(name + ": this libfreenect gives no depth in mm and colour of 640x480.",
                "Install Debian's libfreenect0.5.");
  }
  first_message.clear();
  api().set_depth_callback(device_, receiveDepth);
  api().set_video_callback(device_, receiveColor);
  is_started_ = true;  // set first, because a failure below may leave one stream started
  if (api().set_depth_mode(device_, depth) < 0 || api().set_video_mode(device_, color) < 0 ||
      api().start_depth(device_) < 0 || api().start_video(device_) < 0) {
    return fail(name + " cannot be started: " + reason() + ".",
                "Is another program using it? Else plug it into another USB port, one of its own.");
  }
  return {};
}

FreenectCamera::~FreenectCamera() {
  if (is_started_) {
    api().stop_depth(device_);
    api().stop_video(device_);
  }
  if (device_ != nullptr) {
    api().close_device(device_);
  }
}

Result<DepthColorStreams::Arrival> FreenectCamera::wait(std::chrono::milliseconds timeout) {
  const auto deadline = api().now() + timeout;
  while (received_.images.empty()) {
    const auto left = std::chrono::duration_cast<microseconds>(deadline - api().now()).count();
    if (left <= 0) {
      return Arrival{};
    }
    timeval time{.tv_sec = static_cast<time_t>(left / 1'000'000),
                 .tv_usec = static_cast<suseconds_t>(left % 1'000'000)};
    first_message.clear();
    receiver = &received_;
    const int status = api().process_events_timeout(context_->get(), &time);
    receiver = nullptr;
    if (status < 0 && status != kInterrupted) {
      return fail(reason());
    }
  }
  return nextReceived();
}

DepthColorStreams::Arrival FreenectCamera::nextReceived() {
  FreenectReceived::Image next = std::move(received_.images.front());
  received_.images.pop_front();
  Arrival arrival;
  if (next.is_depth) {
    arrival.depth = StreamImage{std::move(next.image), clock_.depthSeconds(next.ticks)};
  } else {
    arrival.color = StreamImage{std::move(next.image), clock_.colorSeconds(next.ticks)};
  }
  return arrival;
}

Intrinsics FreenectCamera::intrinsics() const {
  // Registered depth uses the colour camera's pixels; the makers' drivers assume 525.
  return is_registered_ ? kPrimeSenseIntrinsics : kDepthCamera;
}

}  // namespace scantrove
