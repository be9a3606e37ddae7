#pragma once
#include <span>
#include <string_view>

#include "core/base/result.h"

namespace scantrove {

class DatabaseConnection;

namespace schema {

/// One step of a schema: a module's schema/NNN_name.sql, embedded at build, the steps of a module in order.
/// Statements end in `;`, comments start with
/// `--`; neither `;` nor `--` may stand inside a string of the SQL.
struct Migration {
  int version;
  std::string_view name;  ///< the file's name
  std::string_view sql;
};

/// What a file is; its first step sets the same application id.
struct FileKind {
  int application_id;
  std::string_view called;  ///< "catalogue"
};

/// Brings the file to the newest of `steps`, all missing ones in one transaction, and to WAL mode; the
/// version is PRAGMA user_version (and, with dates, the table schema_migrations). Error: the file is newer
/// than this program, belongs to another program, is damaged, or cannot be written; then nothing was changed.
Result<void> migrate(DatabaseConnection& connection, const FileKind& kind, std::span<const Migration> steps);

/// The version of a file that is only read, and not to be changed. Error: as migrate(); older than `oldest`,
/// or there is nothing in it.
[[nodiscard]] Result<int> versionToRead(DatabaseConnection& connection, const FileKind& kind,
                                        std::span<const Migration> steps, int oldest);

}  // namespace schema
}  // namespace scantrove
