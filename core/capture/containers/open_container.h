#pragma once
#include <filesystem>
#include <memory>
#include <optional>

#include "core/base/result.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// Formats of files that hold a whole recording, by their first bytes.
enum class ContainerFormat { ros_bag, rosbag2_database, mcap, matroska };

/// The format of a regular file; empty: none of these. Error: the file cannot be read.
[[nodiscard]] Result<std::optional<ContainerFormat>> containerFormat(const std::filesystem::path& file);

/// Opens a container as a recording. Error: names the file.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openContainer(const std::filesystem::path& file,
                                                                 ContainerFormat format,
                                                                 const SourceOptions& options);

/// What to do with a recording that cannot be read because only its maker's tool can (.svo, .mp4, .xef ...),
/// by its first bytes and its name. Empty: unknown.
[[nodiscard]] std::string adviceForContainer(const std::filesystem::path& file);

/// The recording in a folder of rosbag2 (metadata.yaml beside .db3 or .mcap files). Empty: no such folder.
/// Error: several files.
[[nodiscard]] Result<std::optional<std::filesystem::path>> rosbag2FileIn(const std::filesystem::path& folder);

}  // namespace scantrove
