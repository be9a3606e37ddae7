#pragma once
#include <filesystem>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Reads a text file without its byte order mark, which some editors write. Error: as readFile; UTF-16
/// text, which these editors write as well; more than 512 MB.
[[nodiscard]] Result<std::string> readTextFile(const std::filesystem::path& file);

}  // namespace scantrove
