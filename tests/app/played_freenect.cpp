// Replaces libfreenect in a program under test: a Kinect v1 before a wall that comes nearer by 1 mm per
// image. It is unplugged after PLAYED_FREENECT_IMAGES images, if that is set.
#include <libfreenect.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

namespace {

constexpr int kPixels = 640 * 480;
constexpr std::uint32_t kTicks = 2'000'000;  // 1/30 s

struct Camera {
  freenect_depth_cb on_depth = nullptr;
  freenect_video_cb on_color = nullptr;
  freenect_log_cb log = nullptr;
  int images = 0;
};
Camera camera;

freenect_context* context() { return reinterpret_cast<freenect_context*>(&camera); }
freenect_device* device() { return reinterpret_cast<freenect_device*>(&camera); }

freenect_frame_mode mode(int bytes_per_pixel, int format) {
  freenect_frame_mode made{};
  made.dummy = format;
  made.bytes = kPixels * bytes_per_pixel;
  made.width = 640;
  made.height = 480;
  made.is_valid = 1;
  return made;
}

}  // namespace

extern "C" {

int freenect_init(freenect_context** made, freenect_usb_context*) {
  *made = context();
  return 0;
}
int freenect_shutdown(freenect_context*) { return 0; }
void freenect_set_log_level(freenect_context*, freenect_loglevel) {}
void freenect_set_log_callback(freenect_context*, freenect_log_cb log) { camera.log = log; }
void freenect_select_subdevices(freenect_context*, freenect_device_flags) {}
int freenect_num_devices(freenect_context*) { return 1; }
int freenect_open_device(freenect_context*, freenect_device** opened, int) {
  *opened = device();
  return 0;
}
int freenect_open_device_by_camera_serial(freenect_context*, freenect_device**, const char*) { return -1; }
int freenect_close_device(freenect_device*) { return 0; }
freenect_frame_mode freenect_find_depth_mode(freenect_resolution, freenect_depth_format format) {
  return mode(2, format);
}
freenect_frame_mode freenect_find_video_mode(freenect_resolution, freenect_video_format format) {
  return mode(3, format);
}
int freenect_set_depth_mode(freenect_device*, freenect_frame_mode) { return 0; }
int freenect_set_video_mode(freenect_device*, freenect_frame_mode) { return 0; }
void freenect_set_depth_callback(freenect_device*, freenect_depth_cb receiver) { camera.on_depth = receiver; }
void freenect_set_video_callback(freenect_device*, freenect_video_cb receiver) { camera.on_color = receiver; }
int freenect_start_depth(freenect_device*) { return 0; }
int freenect_start_video(freenect_device*) { return 0; }
int freenect_stop_depth(freenect_device*) { return 0; }
int freenect_stop_video(freenect_device*) { return 0; }

int freenect_process_events_timeout(freenect_context*, timeval*) {
  const char* const most = std::getenv("PLAYED_FREENECT_IMAGES");
  if (most != nullptr && camera.images >= std::atoi(most)) {
    camera.log(context(), FREENECT_LOG_ERROR, "USB device disappeared\n");
    return -1;
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(10));  // leaves time to the reader's other threads
  std::vector<std::uint8_t> color(3 * kPixels, 0);
  for (std::size_t i = 0; i < color.size(); i += 3) color[i] = 200;  // red
  std::vector<std::uint16_t> depth(kPixels, static_cast<std::uint16_t>(std::max(500, 2000 - camera.images)));
  const std::uint32_t ticks = kTicks * static_cast<std::uint32_t>(camera.images++);
  camera.on_color(device(), color.data(), ticks);
  camera.on_depth(device(), depth.data(), ticks);
  return 0;
}
}
