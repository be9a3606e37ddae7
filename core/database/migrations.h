#pragma once
#include <span>
#include <string_view>

#include "core/base/result.h"

namespace scantrove {

class DatabaseConnection;

namespace schema {

/// One step of a schema: a module's schema/NNN_name.sql, embedded at build, in order. Statements end in `;`,
/// comments start with `--`; the SQL's strings must contain neither. See also inDialect().
struct Migration {
  int version;
  std::string_view name;  ///< the file's name
  std::string_view sql;
};

/// The kind of a database file; its first step sets the same application id.
struct FileKind {
  int application_id;
  std::string_view called;  ///< "catalogue"
};

/// Applies all missing `steps` in one transaction, and switches to WAL mode. The version of a file is PRAGMA
/// user_version, that of a server's database stands in the table scantrove_schema (and, with dates, in
/// schema_migrations). Error: the database is newer than this program, belongs to another program, is
/// damaged, or cannot be written; it is then unchanged.
Result<void> migrate(DatabaseConnection& connection, const FileKind& kind, std::span<const Migration> steps);

/// The version of a file that is only read. Error: as migrate(); older than `oldest`, or empty.
[[nodiscard]] Result<int> versionToRead(DatabaseConnection& connection, const FileKind& kind,
                                        std::span<const Migration> steps, int oldest);

}  // namespace schema
}  // namespace scantrove
