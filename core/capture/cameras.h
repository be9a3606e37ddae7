#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

/// A camera that OpenNI2 sees now.
struct CameraInfo {
  std::string uri;  ///< opens it: `camera:URI`
  std::string name;
  std::string vendor;
};

/// The cameras that are plugged in; the virtual one (`camera:Dummy`) and opened recordings are not among
/// them. Error: OpenNI2 cannot start.
[[nodiscard]] Result<std::vector<CameraInfo>> listCameras();

/// What a person can do when no camera is found or one cannot be opened.
[[nodiscard]] std::string cameraAdvice();

}  // namespace scantrove
