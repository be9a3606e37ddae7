#pragma once
#include <filesystem>
#include <optional>

#include "core/base/result.h"

namespace scantrove {

/// The first entry in `folder`/map or `folder`/keyframes with a name that no session uses. Hidden `.part`
/// files of killed programs do not count.
[[nodiscard]] std::optional<std::filesystem::path> findForeignFile(const std::filesystem::path& folder);

/// Creates the folders of a session. Error: creation failed, or one in `folder` is a symbolic link.
[[nodiscard]] Result<void> makeSessionFolders(const std::filesystem::path& folder);

/// Error: a file or folder that a session in `folder` writes is a symbolic link, which may lead anywhere on
/// this computer.
[[nodiscard]] Result<void> checkHasNoLinks(const std::filesystem::path& folder);
[[nodiscard]] Error isALink(const std::filesystem::path& path);

/// Syncs the file names in `folder` to disk. Error: the disk failed.
[[nodiscard]] Result<void> flushFolder(const std::filesystem::path& folder);
/// Syncs a file to disk. Error: the disk failed.
[[nodiscard]] Result<void> flushFile(const std::filesystem::path& file);

}  // namespace scantrove
