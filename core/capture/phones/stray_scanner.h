#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/image_sequence.h"

namespace scantrove {

/// Whether the folder is a recording of Stray Scanner: depth/ beside odometry.csv and rgb.mp4 or rgb/.
[[nodiscard]] bool isStrayScannerFolder(const std::filesystem::path& folder,
                                        const std::vector<std::string>& names);

/// Its frames, one a line of odometry.csv. The camera is each line's own (apps since 2026), else that of
/// camera_matrix.csv, which is the last frame's. Colour is decoded from the video while frames are read.
/// Error: names the file.
[[nodiscard]] Result<ImageSequence> readStrayScannerFolder(const std::filesystem::path& folder);

}  // namespace scantrove
