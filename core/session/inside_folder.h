#pragma once
#include <filesystem>

namespace scantrove {

/// Whether `file`, relative to `folder`, stays inside of it once all links are resolved, and is a regular
/// file or missing. A session of another person may name any file of this computer. Any thread.
[[nodiscard]] bool isInsideFolder(const std::filesystem::path& folder, const std::filesystem::path& file);

}  // namespace scantrove
