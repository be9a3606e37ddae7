#pragma once
#include <libfreenect.h>

#include <chrono>

namespace scantrove {

/// A table of libfreenect's functions, under their own names, and the clock. Tests replace them to simulate a
/// camera.
struct FreenectApi {
  decltype(&freenect_init) init;
  decltype(&freenect_shutdown) shutdown;
  decltype(&freenect_set_log_level) set_log_level;
  decltype(&freenect_set_log_callback) set_log_callback;
  decltype(&freenect_select_subdevices) select_subdevices;
  decltype(&freenect_num_devices) num_devices;
  decltype(&freenect_open_device) open_device;
  decltype(&freenect_open_device_by_camera_serial) open_device_by_camera_serial;
  decltype(&freenect_close_device) close_device;
  freenect_frame_mode (*find_depth_mode)(freenect_resolution, freenect_depth_format);
  freenect_frame_mode (*find_video_mode)(freenect_resolution, freenect_video_format);
  decltype(&freenect_set_depth_mode) set_depth_mode;
  decltype(&freenect_set_video_mode) set_video_mode;
  decltype(&freenect_set_depth_callback) set_depth_callback;
  decltype(&freenect_set_video_callback) set_video_callback;
  decltype(&freenect_start_depth) start_depth;
  decltype(&freenect_start_video) start_video;
  decltype(&freenect_stop_depth) stop_depth;
  decltype(&freenect_stop_video) stop_video;
  decltype(&freenect_process_events_timeout) process_events_timeout;
  std::chrono::steady_clock::time_point (*now)();
};

/// The installed library.
[[nodiscard]] const FreenectApi& libfreenect();

}  // namespace scantrove
