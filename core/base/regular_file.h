#pragma once
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Checks that `file` is a regular file, or a link to one. Error: names it and its type (a folder, a pipe, a
/// device ...) or the system's reason. Opens nothing, because a pipe would block and a device might react.
[[nodiscard]] Result<void> checkRegularFile(const std::filesystem::path& file);

/// Reads the first `limit` bytes of a regular file, or all if it is shorter. Error: as checkRegularFile, or
/// the system's reason.
[[nodiscard]] Result<std::string> readFile(const std::filesystem::path& file,
                                           std::size_t limit = std::numeric_limits<std::size_t>::max());

}  // namespace scantrove
