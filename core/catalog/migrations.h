#pragma once
#include <span>
#include <string_view>

#include "core/base/result.h"

namespace scantrove {

class DatabaseConnection;

namespace schema {

/// One step of the schema: schema/NNN_name.sql, embedded at build. Statements end in `;`, comments start with
/// `--`; neither `;` nor `--` may stand inside a string of the SQL.
struct Migration {
  int version;
  std::string_view name;  ///< the file's name
  std::string_view sql;
};

/// All steps, ascending, versions 1, 2, ...
[[nodiscard]] std::span<const Migration> migrations();

/// Brings the file to the newest of `steps`, all missing ones in one transaction, and to WAL mode; the
/// version is PRAGMA user_version (and, with dates, the table schema_migrations). Error: the file is newer
/// than this program, belongs to another program, is damaged, or cannot be written; then nothing was changed.
Result<void> migrate(DatabaseConnection& connection, std::span<const Migration> steps = migrations());

}  // namespace schema
}  // namespace scantrove
