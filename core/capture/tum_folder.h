#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Whether the names of a folder's files include `depth.txt`.
[[nodiscard]] bool isTumFolder(const std::vector<std::string>& names);

/// A TUM RGB-D folder: `depth.txt` and `rgb.txt` list timestamped images (depth / 5000 = m), paired within
/// 0.02 s; `groundtruth.txt` gives poses where present. Without `rgb.txt` depth only. Index = position among
/// the pairs, timestamp = the depth image's. Intrinsics by the camera that the folder's name or the lists'
/// comments name (freiburg1, 2, 3).
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openTumFolder(const std::filesystem::path& folder,
                                                                 const SourceOptions& options);

/// Pairs (position in a, position in b) of two sorted lists of times: the closest pairs first, none further
/// apart than `tolerance_s`, each element in one pair at most; sorted by position.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> associateTimes(const std::vector<double>& a,
                                                                              const std::vector<double>& b,
                                                                              double tolerance_s);

}  // namespace scantrove
