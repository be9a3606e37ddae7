#include "core/capture/freenect_api.h"

namespace scantrove {

const FreenectApi& libfreenect() {
  static constexpr FreenectApi kLibrary{
      .init = freenect_init,
      .shutdown = freenect_shutdown,
      .set_log_level = freenect_set_log_level,
      .set_log_callback = freenect_set_log_callback,
      .select_subdevices = freenect_select_subdevices,
      .num_devices = freenect_num_devices,
      .open_device = freenect_open_device,
      .open_device_by_camera_serial = freenect_open_device_by_camera_serial,
      .close_device = freenect_close_device,
      .find_depth_mode = freenect_find_depth_mode,
      .find_video_mode = freenect_find_video_mode,
      .set_depth_mode = freenect_set_depth_mode,
      .set_video_mode = freenect_set_video_mode,
      .set_depth_callback = freenect_set_depth_callback,
      .set_video_callback = freenect_set_video_callback,
      .start_depth = freenect_start_depth,
      .start_video = freenect_start_video,
      .stop_depth = freenect_stop_depth,
      .stop_video = freenect_stop_video,
      .process_events_timeout = freenect_process_events_timeout,
      .now = std::chrono::steady_clock::now,
  };
  return kLibrary;
}

}  // namespace scantrove
