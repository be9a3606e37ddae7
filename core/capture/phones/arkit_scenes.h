#pragma once
#include <filesystem>

#include "core/base/result.h"
#include "core/capture/image_sequence.h"

namespace scantrove {

/// Whether the folder is a scene of ARKitScenes, or has one in NAME_frames/: lowres_depth/ beside
/// lowres_wide.traj.
[[nodiscard]] bool isArkitScenesFolder(const std::filesystem::path& folder);

/// Its frames with the low-resolution colour, by time. Error: names the file; no frame has depth and a
/// camera.
[[nodiscard]] Result<ImageSequence> readArkitScenesFolder(const std::filesystem::path& folder);

}  // namespace scantrove
