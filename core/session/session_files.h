#pragma once
#include <filesystem>
#include <optional>

#include "core/base/result.h"

namespace scantrove {

/// The first entry in `folder`/map or `folder`/keyframes that no session writes there, by its name. Hidden
/// `.part` files of killed programs do not count.
[[nodiscard]] std::optional<std::filesystem::path> findForeignFile(const std::filesystem::path& folder);

/// Makes the folders of a session. Error: they cannot be made, or one in `folder` is a symbolic link.
[[nodiscard]] Result<void> makeSessionFolders(const std::filesystem::path& folder);

/// Error: a file or folder that a session in `folder` writes is a symbolic link, and so may be anything of
/// this computer.
[[nodiscard]] Result<void> checkHasNoLinks(const std::filesystem::path& folder);
[[nodiscard]] Error isALink(const std::filesystem::path& path);

/// Brings the names of the files in `folder` to the disk. Error: the disk failed.
[[nodiscard]] Result<void> flushFolder(const std::filesystem::path& folder);
/// Brings a file to the disk. Error: the disk failed.
[[nodiscard]] Result<void> flushFile(const std::filesystem::path& file);

}  // namespace scantrove
