#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

/// The sources of a list file: one a line; empty lines and lines that begin with '#' are comments. Relative
/// paths start at the file's folder, so that a list may be used from anywhere. `is_path` tells paths from
/// cameras and demos. Error: the file cannot be read, or it names no source.
[[nodiscard]] Result<std::vector<std::string>> readRecordingList(
    const std::filesystem::path& file, const std::function<bool(const std::string&)>& is_path);

/// `sources` in their order, each once.
[[nodiscard]] std::vector<std::string> withoutRepetitions(std::vector<std::string> sources);

}  // namespace scantrove
