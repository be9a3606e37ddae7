#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/camera_info.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Lists connected cameras: OpenNI2's, libfreenect's (Kinect v1), then those of listLiveCameras(). Excludes
/// the virtual one (`camera:Dummy`) and opened recordings. Error: OpenNI2 cannot start, and there is no
/// other.
[[nodiscard]] Result<std::vector<CameraInfo>> listCameras();

/// Opens a live camera by a URI from listCameras() or "freenect:SERIAL"; empty: the first connected one. See
/// openOpenNiCamera(), openFreenectCamera() and openLiveCamera(). Error: no camera found, or it cannot be
/// opened; says what to check.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openCamera(const std::string& uri,
                                                              const SourceOptions& options);

/// Advice for a camera that is missing or cannot be opened.
[[nodiscard]] std::string cameraAdvice();

}  // namespace scantrove
