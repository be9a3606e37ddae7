#pragma once
#include <string>

namespace scantrove {

/// A camera that a driver currently reports.
struct CameraInfo {
  std::string uri;  ///< opens it: `camera:URI`
  std::string name;
  std::string vendor;
  std::string driver = "OpenNI2";  ///< or "libfreenect", "V4L2", "usbmuxd"
};

}  // namespace scantrove
