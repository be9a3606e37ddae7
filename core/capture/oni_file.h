#pragma once
#include <filesystem>

#include "core/base/result.h"

namespace scantrove {

/// Walks the records of an .oni file to its end record and checks their sizes and names: OpenNI2 trusts every
/// one of them. Values and images are not read. Error: names the file; not regular, no recording, damaged,
/// truncated.
[[nodiscard]] Result<void> checkOniFile(const std::filesystem::path& file);

}  // namespace scantrove
