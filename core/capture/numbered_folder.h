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

/// A folder with `depth/` and `color/`, `image/` or `rgb/`, one file a frame (Open3D, Redwood); depth in mm
/// unless options differ. Colour and depth are paired by the numbers in their names: index = the number,
/// timestamp = index / 30. Names without numbers, or with times, are paired by equal names: index = position
/// in sorted order, timestamp = the name's time (unit: time_unit.h), else index / 30. Without a colour folder
/// the recording is depth only. Intrinsics come from options, else a file (see findIntrinsics), else 525 525
/// 319.5 239.5 with a warning. Poses come from `trajectory.log` where present.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openNumberedFolder(const std::filesystem::path& folder,
                                                                      const SourceOptions& options);

/// The number in a file's name without extension: its last run of digits, or the first in
/// `0000012-000000400012`, where the last is a time. Empty if there is none or it has too many digits.
enum class DigitRun { last, first };
[[nodiscard]] std::optional<int> numberInName(const std::string& stem, DigitRun run);

}  // namespace scantrove
