#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Whether the names of a folder's files include `depth.txt`.
[[nodiscard]] bool isTumFolder(const std::vector<std::string>& names);

/// A TUM RGB-D folder: `depth.txt` and `rgb.txt` list timestamped images (depth / 5000 = m), paired within
/// 0.02 s; `groundtruth.txt` gives poses where present. Without `rgb.txt` depth only. Index = position among
/// the pairs, timestamp = the depth image's. Milli-, micro- and nanoseconds are recognised by their spacing
/// (see time_unit.h), with a warning. Intrinsics come from a file (see findIntrinsics), else from the camera
/// named in the folder's name or the lists' comments (freiburg1, 2, 3, or the Bonn data set, whose ground
/// truth is that of markers and gives no poses).
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openTumFolder(const std::filesystem::path& folder,
                                                                 const SourceOptions& options);

}  // namespace scantrove
