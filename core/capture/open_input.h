#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Whether `source` names a camera: `camera`, `camera:URI`, `freenect`, `freenect:INDEX`, `freenect:SERIAL`
/// (a Kinect v1), `realsense`, `realsense:SERIAL`, `realsense:/dev/videoN`, `record3d`, `record3d:UDID`.
[[nodiscard]] bool isCameraName(const std::string& source);

/// Whether `folder` is a recording (see folder_formats.h). Error: it cannot be listed.
[[nodiscard]] Result<bool> isRecordingFolder(const std::filesystem::path& folder);

/// Opens a camera, a recording's file or folder, detecting its type. Error: names the path, the formats that
/// were tried, and what to do.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openInput(const std::string& source,
                                                             const SourceOptions& options);

}  // namespace scantrove
