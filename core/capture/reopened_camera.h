#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/camera_info.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Opens the camera `source` (see isCameraName()) again after it was lost. A camera of OpenNI2 may have
/// another URI then, because that names the port and the device's number: the only connected camera of the
/// same model is taken. Error: as openInput.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> reopenCamera(const std::string& source,
                                                                const SourceOptions& options);

/// The URI of the only one of `cameras` that is of the model of `uri` ("1d27/0601@1/5": model, '@', place).
/// Empty: there is none, or several.
[[nodiscard]] std::string sameModel(const std::string& uri, const std::vector<CameraInfo>& cameras);

}  // namespace scantrove
