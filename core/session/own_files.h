#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"

/// The record of the files that a scan made in its session's folder (table `files`). Only these are ever
/// removed or written over; a file of the same form that is not in it is somebody's. Names are relative to
/// the folder.
namespace scantrove::own_files {

/// Enters `name` before the file is made. False: there is a file of that name already. Error: the database.
[[nodiscard]] Result<bool> claim(DatabaseConnection& database, const std::filesystem::path& folder,
                                 const std::string& name);

/// In a transaction: rows name these files from now on.
[[nodiscard]] Result<void> keep(DatabaseConnection& database, std::span<const std::string> names);
/// In a transaction: no row names these files any more.
[[nodiscard]] Result<void> outdate(DatabaseConnection& database, std::span<const std::string> names);
/// Takes a file out of the record.
[[nodiscard]] Result<void> disown(DatabaseConnection& database, const std::string& name);
/// The files that rows name.
[[nodiscard]] Result<std::vector<std::string>> kept(DatabaseConnection& database);

enum class Which { outdated, outdated_and_new };
/// Removes the files that no row names. `outdated_and_new`: also those that a killed program had begun. What
/// cannot be removed stays in the record.
[[nodiscard]] Result<void> removeUnused(DatabaseConnection& database, const std::filesystem::path& folder,
                                        Which which);

/// 000001.bricks in map/, or an image in keyframes/: the only names that are ever removed.
[[nodiscard]] bool hasFormOfOurs(const std::filesystem::path& name);

}  // namespace scantrove::own_files
