#pragma once
#include <cstring>
#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "core/capture/freenect_api.h"

namespace scantrove::test {

/// Simulates libfreenect with one Kinect, or none, and a test's list of events. Only events advance time. One
/// instance at a time.
class FakeFreenect {
 public:
  static constexpr std::uint32_t kTicksPerSecond = 60'000'000;
  using Event = std::function<int()>;  ///< effect and return value of one call of process_events_timeout()

  int cameras = 1;
  int init_status = 0;
  int open_status = 0;
  std::string open_message;
  std::string serial = "A00362A17284043A";
  freenect_frame_mode depth_mode = mode(2, FREENECT_DEPTH_REGISTERED);
  freenect_frame_mode color_mode = mode(3, FREENECT_VIDEO_RGB);
  int start_color_status = 0;
  std::deque<Event> events;  ///< no events after the last; calls then use up their timeout

  std::vector<std::string> calls;  ///< in order
  freenect_depth_format asked_depth = FREENECT_DEPTH_11BIT;
  int opened_index = -1;
  freenect_device_flags subdevices{};
  int waits = 0;  ///< calls of process_events_timeout() that timed out

  FakeFreenect() { current_ = this; }
  FakeFreenect(const FakeFreenect&) = delete;
  FakeFreenect& operator=(const FakeFreenect&) = delete;
  ~FakeFreenect() { current_ = nullptr; }

  static freenect_frame_mode mode(int bytes_per_pixel, int format) {
    freenect_frame_mode mode{};
    mode.resolution = FREENECT_RESOLUTION_MEDIUM;
    mode.dummy = format;
    mode.bytes = 640 * 480 * bytes_per_pixel;
    mode.width = 640;
    mode.height = 480;
    mode.is_valid = 1;
    return mode;
  }

  /// A depth image of a constant value; the first pixel is 0.1 m farther.
  void depthAt(std::uint32_t ticks, std::uint16_t value_mm) {
    events.emplace_back([this, ticks, value_mm] {
      std::vector<std::uint16_t> image(640U * 480U, value_mm);
      image.front() = static_cast<std::uint16_t>(value_mm + 100);
      on_depth_(device(), image.data(), ticks);
      return 0;
    });
  }
  /// A uniform colour image.
  void colorAt(std::uint32_t ticks, std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    events.emplace_back([this, ticks, red, green, blue] {
      std::vector<std::uint8_t> image;
      for (int i = 0; i < 640 * 480; ++i) image.insert(image.end(), {red, green, blue});
      on_color_(device(), image.data(), ticks);
      return 0;
    });
  }
  void log(const char* message) const {
    if (log_ != nullptr) log_(context(), FREENECT_LOG_ERROR, message);
  }
  void handOverNothing() { on_depth_(device(), nullptr, 0); }
  [[nodiscard]] bool isAllClosed() const { return open_devices_ == 0 && open_contexts_ == 0; }

  static const FreenectApi& api() {
    static constexpr FreenectApi kApi{
        .init =
            [](freenect_context** made, freenect_usb_context*) {
              if (current_->init_status < 0) return current_->init_status;
              *made = context();
              ++current_->open_contexts_;
              return 0;
            },
        .shutdown =
            [](freenect_context*) {
              --current_->open_contexts_;
              current_->open_devices_ = 0;  // it closes open devices
              return 0;
            },
        .set_log_level = [](freenect_context*, freenect_loglevel) {},
        .set_log_callback = [](freenect_context*, freenect_log_cb log) { current_->log_ = log; },
        .select_subdevices = [](freenect_context*,
                                freenect_device_flags flags) { current_->subdevices = flags; },
        .num_devices = [](freenect_context*) { return current_->cameras; },
        .open_device = [](freenect_context*, freenect_device** opened,
                          int index) { return current_->open(opened, index); },
        .open_device_by_camera_serial =
            [](freenect_context*, freenect_device** opened, const char* requested) {
              if (requested != current_->serial) {
                current_->log("Couldn't find a device with that serial\n");
                return -1;
              }
              return current_->open(opened, 0);
            },
        .close_device = [](freenect_device*) { return current_->did("close", -1); },
        .find_depth_mode =
            [](freenect_resolution, freenect_depth_format format) {
              current_->asked_depth = format;
              return current_->depth_mode;
            },
        .find_video_mode = [](freenect_resolution, freenect_video_format) { return current_->color_mode; },
        .set_depth_mode = [](freenect_device*, freenect_frame_mode) { return 0; },
        .set_video_mode = [](freenect_device*, freenect_frame_mode) { return 0; },
        .set_depth_callback = [](freenect_device*,
                                 freenect_depth_cb receiver) { current_->on_depth_ = receiver; },
        .set_video_callback = [](freenect_device*,
                                 freenect_video_cb receiver) { current_->on_color_ = receiver; },
        .start_depth = [](freenect_device*) { return current_->did("start depth", 0); },
        .start_video =
            [](freenect_device*) {
              current_->did("start colour", 0);
              return current_->start_color_status;
            },
        .stop_depth = [](freenect_device*) { return current_->did("stop depth", 0); },
        .stop_video = [](freenect_device*) { return current_->did("stop colour", 0); },
        .process_events_timeout = [](freenect_context*,
                                     timeval* time) { return current_->processOne(*time); },
        .now = [] { return current_->now_; },
    };
    return kApi;
  }

 private:
  static freenect_context* context() { return reinterpret_cast<freenect_context*>(&context_mark_); }
  static freenect_device* device() { return reinterpret_cast<freenect_device*>(&device_mark_); }

  int did(const char* what, int opened) {
    calls.emplace_back(what);
    open_devices_ += opened;
    return 0;
  }
  int open(freenect_device** opened, int index) {
    if (open_status < 0) {
      log(open_message.c_str());
      log("Failed to open audio subdevice or it is not disabled.");  // libfreenect logs further messages
      return open_status;
    }
    opened_index = index;
    *opened = device();
    return did("open", 1);
  }
  int processOne(const timeval& time) {
    if (events.empty()) {
      ++waits;
      now_ += std::chrono::seconds(time.tv_sec) + std::chrono::microseconds(time.tv_usec);
      return 0;
    }
    const Event event = std::move(events.front());
    events.pop_front();
    return event();
  }

  static inline FakeFreenect* current_ = nullptr;
  static inline int context_mark_ = 0;
  static inline int device_mark_ = 0;
  freenect_log_cb log_ = nullptr;
  freenect_depth_cb on_depth_ = nullptr;
  freenect_video_cb on_color_ = nullptr;
  int open_contexts_ = 0;
  int open_devices_ = 0;
  std::chrono::steady_clock::time_point now_{};
};

}  // namespace scantrove::test
