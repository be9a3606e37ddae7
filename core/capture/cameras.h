#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/camera_info.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// The cameras that are plugged in: OpenNI2's, then libfreenect's (Kinect v1). The virtual one
/// (`camera:Dummy`) and opened recordings are not among them. Error: OpenNI2 cannot start, and libfreenect
/// has no camera either.
[[nodiscard]] Result<std::vector<CameraInfo>> listCameras();

/// Opens a live camera by the URI that listCameras() gives, or "freenect:SERIAL"; empty: the first that is
/// plugged in. See openOpenNiCamera() and openFreenectCamera(). Error: no camera found, or it cannot be
/// opened; says what to check.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openCamera(const std::string& uri,
                                                              const SourceOptions& options);

/// What a person can do when no camera is found or one cannot be opened.
[[nodiscard]] std::string cameraAdvice();

}  // namespace scantrove
