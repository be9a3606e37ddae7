#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Whether the names of a folder's files include a raw depth image of NYUv2 (d-TIME-TICKS.pgm).
[[nodiscard]] bool isNyuRawFolder(const std::vector<std::string>& names);

/// A raw scene of NYUv2: d-TIME-TICKS.pgm (values of the Kinect, with their bytes swapped), r-TIME-TICKS.ppm
/// and a-TIME-TICKS.dump, which is ignored. Each depth image is paired with the nearest colour image
/// (nyuRawPairs). Frames are those of the undistorted colour camera (NyuProjection). Index = position in
/// order of time, timestamp = the depth image's. Frames with a missing or truncated file are skipped.
/// `names` are those of the folder.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openNyuRawFolder(const std::filesystem::path& folder,
                                                                    const std::vector<std::string>& names,
                                                                    const SourceOptions& options);

}  // namespace scantrove
