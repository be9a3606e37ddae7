#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/image_sequence.h"

namespace scantrove {

/// Whether the folder is an "EXR + RGBD" export of Record3D: metadata.json with poses, and depth/N.exr.
[[nodiscard]] bool isRecord3dFolder(const std::filesystem::path& folder);

/// Its frames by number. Error: names the file.
[[nodiscard]] Result<ImageSequence> readRecord3dFolder(const std::filesystem::path& folder);

/// Whether the file is a recording of Record3D: named .r3d, or a zip archive with its metadata.
[[nodiscard]] bool isRecord3dFile(const std::filesystem::path& file);

/// Its frames by number, read from the archive one by one. Error: names the file.
[[nodiscard]] Result<ImageSequence> readRecord3dFile(const std::filesystem::path& file);

}  // namespace scantrove
