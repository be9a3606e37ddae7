#pragma once
#include <filesystem>

#include "core/base/result.h"
#include "core/capture/image_sequence.h"

namespace scantrove {

/// Whether the folder is a raw-data export of Polycam: keyframes/ with depth/ and cameras/ or
/// corrected_cameras/.
[[nodiscard]] bool isPolycamFolder(const std::filesystem::path& folder);

/// Its key frames, in the order of their times: images and cameras as Polycam optimised them ("corrected")
/// where they are, else as recorded. Error: no frame that has a camera and depth.
[[nodiscard]] Result<ImageSequence> readPolycamFolder(const std::filesystem::path& folder);

}  // namespace scantrove
