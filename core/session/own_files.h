#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"

/// The record of the files that a scan created in its session's folder (table `files`). Only these are
/// removed or overwritten; similar files that are not in it belong to someone else. Names are relative to
/// the folder.
namespace scantrove::own_files {

/// Enters `name` before the file is created. False: the file exists already. Error: the database.
[[nodiscard]] Result<bool> claim(DatabaseConnection& database, const std::filesystem::path& folder,
                                 const std::string& name);

/// In a transaction: rows name these files from now on.
[[nodiscard]] Result<void> keep(DatabaseConnection& database, std::span<const std::string> names);
/// In a transaction: no row names these files any more.
[[nodiscard]] Result<void> outdate(DatabaseConnection& database, std::span<const std::string> names);
/// Deletes a file's entry.
[[nodiscard]] Result<void> disown(DatabaseConnection& database, const std::string& name);
/// The files that rows name.
[[nodiscard]] Result<std::vector<std::string>> kept(DatabaseConnection& database);

enum class Which { outdated, outdated_and_new };
/// Removes the files that no row names. `outdated_and_new`: also the unfinished ones of a killed program.
/// Files that cannot be removed stay in the record.
[[nodiscard]] Result<void> removeUnused(DatabaseConnection& database, const std::filesystem::path& folder,
                                        Which which);

/// 000001.bricks in map/, or an image in keyframes/: only such names are ever removed.
[[nodiscard]] bool hasFormOfOurs(const std::filesystem::path& name);

}  // namespace scantrove::own_files
