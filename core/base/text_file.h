#pragma once
#include <filesystem>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// The text of a regular file, without the byte order mark that some editors write before it. Error: as
/// readFile, or a text of 16 bits a letter (UTF-16), which these editors write as well.
[[nodiscard]] Result<std::string> readTextFile(const std::filesystem::path& file);

}  // namespace scantrove
