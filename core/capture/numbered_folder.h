#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/capture/frame_source.h"

namespace scantrove {

/// Whether a folder has a subfolder `depth` (checked on the disk, since a file may have that name).
[[nodiscard]] bool isNumberedFolder(const std::filesystem::path& folder);

/// A folder with `depth/` and `color/`, `image/` or `rgb/`, one file a frame (Open3D, Redwood), depth in mm
/// unless options say else. Colour and depth are paired by the numbers in their names: index = the number,
/// timestamp = index / 30. Where names have none, or are times, they are paired by equal names: index = place
/// in their order, timestamp = the time that the name is (its unit: time_unit.h), else index / 30. Without a
/// colour folder depth only. Intrinsics from options, else from a file (see
/// findIntrinsics), else 525 525 319.5 239.5 with a warning. Poses from `trajectory.log` where present.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openNumberedFolder(const std::filesystem::path& folder,
                                                                      const SourceOptions& options);

/// The number in a file's name without extension: its last run of digits, or its first
/// (`0000012-000000400012`: the first is the number, the last a time). Empty if there is none or it has too
/// many digits.
enum class DigitRun { last, first };
[[nodiscard]] std::optional<int> numberInName(const std::string& stem, DigitRun run);

}  // namespace scantrove
