#pragma once
#include <filesystem>
#include <memory>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Whether a folder has `rgb/`, `depth/` and `cam_K.txt`.
[[nodiscard]] bool isFoundationPoseFolder(const std::filesystem::path& folder);

/// A folder as FoundationPose and BundleSDF take it: `rgb/NAME.png`, `depth/NAME.png` in mm, registered, one
/// camera in `cam_K.txt` (3x3); NAME is often a time of 19 digits. `masks/` is not read. No poses. Error:
/// names the file.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openFoundationPoseFolder(
    const std::filesystem::path& folder, const SourceOptions& options);

}  // namespace scantrove
