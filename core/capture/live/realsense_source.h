#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/capture/camera_info.h"
#include "core/capture/frame_source.h"

namespace scantrove {

class VideoSystem;

/// Whether it is "realsense", "realsense:SERIAL" (USB's serial number) or "realsense:/dev/videoN".
[[nodiscard]] inline bool isRealsenseUri(std::string_view uri) {
  return uri == "realsense" || uri.starts_with("realsense:");
}

/// Connected cameras of the series D400 that the kernel drives. Opens no node. `root`: see readUsbDevices().
[[nodiscard]] std::vector<CameraInfo> listRealsenseCameras(const std::filesystem::path& root = "/");

/// Opens a RealSense D4xx by such a URI through Video4Linux, without the maker's SDK; "realsense": the first.
/// 640x480 at 30 Hz, in units of 1 mm (D405: 0.1 mm). Intrinsics: --intrinsics, else the camera's own
/// calibration, else the usual ones of the model with a warning. next() waits a second at most (timeout); an
/// unplugged camera is `failed`. Error: none found, busy, no permission; says what to check. Not yet tested
/// with a real camera.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openRealsenseCamera(const std::string& uri,
                                                                       const SourceOptions& options);

/// The same with replaced system calls below another root, for tests.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openRealsenseCamera(VideoSystem& system,
                                                                       const std::filesystem::path& root,
                                                                       const std::string& uri,
                                                                       const SourceOptions& options);

}  // namespace scantrove
