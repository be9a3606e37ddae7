#pragma once
#include <filesystem>

#include "core/base/result.h"
#include "core/capture/image_sequence.h"

namespace scantrove {

/// Whether the folder is the iPhone recording of a ScanNet++ scene, or a scene that has one in iphone/:
/// pose_intrinsic_imu.json with depth.bin or depth/.
[[nodiscard]] bool isScannetppFolder(const std::filesystem::path& folder);

/// Its frames by number: depth of depth.bin or of depth/ (extracted), colour of rgb.mkv or of rgb/. Poses are
/// those aligned to the laser scan. Error: names the file.
[[nodiscard]] Result<ImageSequence> readScannetppFolder(const std::filesystem::path& folder);

}  // namespace scantrove
