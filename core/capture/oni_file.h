#pragma once
#include <filesystem>

#include "core/base/result.h"

namespace scantrove {

/// Walks the records of an .oni file (magic, type, sizes) to its end record, without reading what they hold:
/// OpenNI2 trusts every size in them. Error: names the file; not regular, no recording, damaged, truncated.
[[nodiscard]] Result<void> checkOniFile(const std::filesystem::path& file);

}  // namespace scantrove
