#pragma once
#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/capture/image_sequence.h"
#include "core/capture/pose_files.h"

namespace scantrove {

/// The images in a folder, sorted by name. Error: it cannot be listed, or has none.
[[nodiscard]] Result<std::vector<std::filesystem::path>> listImages(const std::filesystem::path& folder);

/// Pairs the images of two folders, for recordings with one file a frame. Equal numbers in names make a pair:
/// index = the number, timestamp = index / 30. Names without numbers, or with times, are paired by equal
/// names: index = position in sorted order, timestamp = the name's time (unit: time_unit.h), else index / 30.
/// `color_folder`: none = depth only. `source`: for messages. Error: no images, or no pairs.
[[nodiscard]] Result<std::vector<ImageSequenceEntry>> pairFolders(
    const std::filesystem::path& depth_folder, const std::optional<std::filesystem::path>& color_folder,
    const std::string& source);

/// Gives each entry the pose of its number; by position, if the poses are numbered from elsewhere.
void addPosesByNumber(ImageSequence& sequence, const std::vector<NumberedPose>& poses);

/// Gives each entry the file of its depth image's name in `folder` as pose, such as pose/12.txt for
/// depth/12.png. `sequence` has poses if one of these files exists.
void addPoseFiles(ImageSequence& sequence, const std::filesystem::path& folder);

/// The size in the header of the first depth image that has one.
[[nodiscard]] std::optional<cv::Size> depthSizeOf(const std::vector<ImageSequenceEntry>& entries);

/// Whether the first name in `folder` is `prefix`, digits and an extension, such as depth00001.png.
[[nodiscard]] bool hasNumberedFiles(const std::filesystem::path& folder, std::string_view prefix);

/// The number in a file's name without extension: its last run of digits, or the first in
/// `0000012-000000400012`, where the last is a time. Empty if there is none or it has too many digits.
enum class DigitRun { last, first };
[[nodiscard]] std::optional<int> numberInName(const std::string& stem, DigitRun run);

}  // namespace scantrove
