#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/image_sequence.h"

namespace scantrove {

/// Whether the folder has single shots of a LiDAR app: NAME_depth.tiff (floating point, metres).
[[nodiscard]] bool isLidarShotsFolder(const std::filesystem::path& folder,
                                      const std::vector<std::string>& names);

/// The shots in the order of their names, with NAME_image.jpg or .png where it is. No poses; the camera is
/// guessed (camera_origin "default") unless a file in the folder gives it.
[[nodiscard]] Result<ImageSequence> readLidarShotsFolder(const std::filesystem::path& folder,
                                                         const std::vector<std::string>& names);

}  // namespace scantrove
