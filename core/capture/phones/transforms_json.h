#pragma once
#include <filesystem>

#include "core/base/result.h"
#include "core/capture/image_sequence.h"

namespace scantrove {

/// Whether the folder has a transforms.json (nerfstudio, instant-ngp, NeRFCapture) whose frames name depth
/// images.
[[nodiscard]] bool isTransformsFolder(const std::filesystem::path& folder);

/// Its frames that have depth, by the number in the names of their depth images. Depth: 16-bit images in the
/// unit that the file tells, else in millimetres; floating point (NumPy, TIFF, OpenEXR) in metres or
/// millimetres; NeRFCapture's floats packed into the four channels of a PNG. Error: names the file.
[[nodiscard]] Result<ImageSequence> readTransformsFolder(const std::filesystem::path& folder);

}  // namespace scantrove
