#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/capture/camera_info.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Whether it is a URI of this folder's cameras: "realsense" or "record3d", alone or with a choice.
[[nodiscard]] bool isLiveCameraUri(std::string_view uri);

/// RealSense D400 cameras, then iPhones and iPads on USB.
[[nodiscard]] std::vector<CameraInfo> listLiveCameras();

/// Opens one by its URI. Error: see openRealsenseCamera() and openRecord3dPhone().
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openLiveCamera(const std::string& uri,
                                                                  const SourceOptions& options);

}  // namespace scantrove
