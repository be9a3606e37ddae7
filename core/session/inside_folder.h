#pragma once
#include <filesystem>

namespace scantrove {

/// Whether `file`, relative to `folder`, resolves to a place inside it through all links, and is a regular
/// file or missing. A session from elsewhere may name any file of this computer. Any thread.
[[nodiscard]] bool isInsideFolder(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace scantrove
