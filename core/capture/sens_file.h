#pragma once
#include <filesystem>
#include <memory>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Opens a `.sens` file (version 4: ScanNet, BundleFusion). Only its index is kept in memory; images are read
/// frame by frame: colour raw, PNG or JPEG, depth raw or zlib, in units of the file. Poses are
/// camera-to-world; frames whose pose is -inf have none. Index = position, timestamp = the depth image's
/// (unit: time_unit.h) where they increase, else index / 30. Frames behind a truncation are left out with a
/// warning. Error: names the file; another version, damaged, no frames, depth compressed by OCCI.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openSensFile(const std::filesystem::path& file,
                                                                const SourceOptions& options);

}  // namespace scantrove
