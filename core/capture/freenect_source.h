#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/capture/camera_info.h"
#include "core/capture/frame_source.h"

namespace scantrove {

struct FreenectApi;

/// Whether this build has libfreenect; without it the functions below return an error that says so.
[[nodiscard]] bool hasFreenect();

/// A parsed URI of a Kinect v1: "freenect", "freenect:", "freenect:INDEX", "freenect:SERIAL".
[[nodiscard]] inline bool isFreenectUri(std::string_view uri) {
  return uri == "freenect" || uri.starts_with("freenect:");
}

/// Connected Kinects v1, including those without permission to open. Error: libfreenect cannot start.
[[nodiscard]] Result<std::vector<CameraInfo>> listFreenectCameras();

/// Opens a Kinect v1 by such a URI; without index or serial number the first. Depth in mm, 640x480,
/// registered to colour unless `options` name a colour camera. Timestamps follow the camera's clock. next()
/// waits a second at most (timeout); an unplugged camera is `failed`. Error: none found, or it cannot be
/// opened; says what to check. Not yet tested with a real camera.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openFreenectCamera(const std::string& uri,
                                                                      const SourceOptions& options);

/// The same with a replaced library, for tests.
[[nodiscard]] Result<std::vector<CameraInfo>> listFreenectCameras(const FreenectApi& api);
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openFreenectCamera(const FreenectApi& api,
                                                                      const std::string& uri,
                                                                      const SourceOptions& options);

}  // namespace scantrove
