#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/image_sequence.h"

namespace scantrove {

/// Whether the folder is an "All Data" export of 3D Scanner App: frame_00000.json with cameraPoseARFrame.
[[nodiscard]] bool isScannerApp3dFolder(const std::filesystem::path& folder,
                                        const std::vector<std::string>& names);

/// Its frames by number; most have no colour. Error: no frame has depth (captures of its "high resolution"
/// mode).
[[nodiscard]] Result<ImageSequence> readScannerApp3dFolder(const std::filesystem::path& folder,
                                                           const std::vector<std::string>& names);

}  // namespace scantrove
