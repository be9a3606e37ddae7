#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Single photographs with depth, each of another scene: NAME-depth.png (mm) beside NAME-color.png, .jpg or
/// .jpeg (mOSD, HOTS). No recording: frames have nothing to do with one another.
struct ImagePairs {
  std::vector<std::string> names;  ///< NAME by frame index, sorted
  std::unique_ptr<FrameSource> frames;
};

/// Intrinsics come from options, else a file (findIntrinsics), else 525 525 319.5 239.5 with a warning.
/// Error: no such pair in the folder, or none that can be read.
[[nodiscard]] Result<ImagePairs> openImagePairs(const std::filesystem::path& folder,
                                                const SourceOptions& options = {});

}  // namespace scantrove
