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

/// Whether this build has libfreenect; without it the functions below say that it has not.
[[nodiscard]] bool hasFreenect();

/// What opens a Kinect v1: "freenect", "freenect:", "freenect:INDEX", "freenect:SERIAL".
[[nodiscard]] inline bool isFreenectUri(std::string_view uri) {
  return uri == "freenect" || uri.starts_with("freenect:");
}

/// The Kinects v1 that are plugged in, those too that the user may not open. Error: libfreenect cannot start.
[[nodiscard]] Result<std::vector<CameraInfo>> listFreenectCameras();

/// Opens a Kinect v1 by a URI as above; without index or serial number the first. Depth in mm, registered to
/// colour (unless `options` name a colour camera), 640x480; timestamps by the camera's clock. next() waits a
/// second at most (timeout); an unplugged camera is `failed`. Error: none found, or it cannot be opened; says
/// what to check. Not tried with a camera so far: none was at hand.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openFreenectCamera(const std::string& uri,
                                                                      const SourceOptions& options);

/// The same with another library than the program's: for tests.
[[nodiscard]] Result<std::vector<CameraInfo>> listFreenectCameras(const FreenectApi& api);
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openFreenectCamera(const FreenectApi& api,
                                                                      const std::string& uri,
                                                                      const SourceOptions& options);

}  // namespace scantrove
