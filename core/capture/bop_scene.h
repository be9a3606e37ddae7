#pragma once
#include <filesystem>
#include <memory>
#include <optional>

#include "core/capture/frame_source.h"

namespace scantrove {

/// The BOP scene in `folder`: the folder itself, if it has `scene_camera.json` and `depth/`, else its only
/// subfolder of that kind, as a data set of one scene has it. Empty: none, or several.
[[nodiscard]] std::optional<std::filesystem::path> findBopScene(const std::filesystem::path& folder);

/// A BOP scene: `rgb/` or `gray/` registered to `depth/NNNNNN.png`, and for each frame in `scene_camera.json`
/// the camera, the depth unit (value x depth_scale = mm) and, where present, the pose (world-to-camera, mm).
/// Where units differ, frames have that of the first. Error: names the file.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openBopScene(const std::filesystem::path& folder,
                                                                const SourceOptions& options);

}  // namespace scantrove
