#pragma once
#include <filesystem>
#include <optional>

#include "core/base/result.h"

namespace scantrove {

/// The first entry in `folder`/map or `folder`/keyframes that no session writes there, by its name. Hidden
/// `.part` files of killed programs do not count.
[[nodiscard]] std::optional<std::filesystem::path> findForeignFile(const std::filesystem::path& folder);

/// Removes the database, the map and the key frames of the session in `folder`, and no file of another name.
/// The database goes last: a program that is killed meanwhile leaves a session. Error: names the folder.
[[nodiscard]] Result<void> removeSessionFiles(const std::filesystem::path& folder);

/// Brings the names of the files in `folder` to the disk. Error: the disk failed.
[[nodiscard]] Result<void> flushFolder(const std::filesystem::path& folder);

}  // namespace scantrove
