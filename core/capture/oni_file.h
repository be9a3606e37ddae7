#pragma once
#include <filesystem>

#include "core/base/result.h"

namespace scantrove {

/// Checks sizes and names of all records of an .oni file up to its end record, because OpenNI2 trusts them.
/// Does not read values and images. Error: names the file; not regular, no recording, damaged, truncated.
[[nodiscard]] Result<void> checkOniFile(const std::filesystem::path& file);

}  // namespace scantrove
