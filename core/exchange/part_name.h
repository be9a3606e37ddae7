#pragma once
#include <filesystem>
#include <string>

namespace scantrove {

/// A new name for a temporary file beside `path`: hidden, random, in the same folder (a rename must not cross
/// file systems). Its last letters are a checksum of the others, by which isPartName() recognises this
/// program's files. Any thread.
[[nodiscard]] std::filesystem::path makePartName(const std::filesystem::path& path);

/// Whether makePartName() created this file name.
[[nodiscard]] bool isPartName(const std::string& name);

}  // namespace scantrove
