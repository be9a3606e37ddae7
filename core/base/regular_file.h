#pragma once
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>

#include "core/base/result.h"

namespace scantrove {

/// Nothing if `file` is a regular file, or a link to one. Error: names it and says what it is (a folder, a
/// pipe, a device ...) or the system's reason. Opens nothing: a pipe would wait for a writer, a device act.
[[nodiscard]] Result<void> checkRegularFile(const std::filesystem::path& file);

/// The first `limit` bytes of a regular file, or all if it is shorter. Error: as checkRegularFile, or the
/// system's reason.
[[nodiscard]] Result<std::string> readFile(const std::filesystem::path& file,
                                           std::size_t limit = std::numeric_limits<std::size_t>::max());

}  // namespace scantrove
