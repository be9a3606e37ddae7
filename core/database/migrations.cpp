#include "core/database/migrations.h"

#include <QString>
#include <QVariant>
#include <algorithm>
#include <string>
#include <vector>

#include "core/database/database_connection.h"
#include "core/database/transaction.h"

namespace scantrove::schema {
namespace {

/// Maximum length of a printed name.
constexpr int kLongestName = 60;

int newestOf(std::span<const Migration> steps) { return steps.empty() ? 0 : steps.back().version; }

std::vector<QString> statementsOf(std::string_view sql) {
  std::vector<QString> statements;
  std::string current;
  for (std::size_t i = 0; i < sql.size(); ++i) {
    if (sql.substr(i, 2) == "--") {
      while (i + 1 < sql.size() && sql[i + 1] != '\n') ++i;
    } else if (sql[i] == ';') {
      statements.push_back(QString::fromStdString(current).trimmed());
      current.clear();
    } else {
      current += sql[i];
    }
  }
  return statements;
}

/// The version of a schema on a server, 0 for a database (or a schema of the search path) without tables.
Result<int> versionOnServer(DatabaseConnection& connection, const FileKind& kind) {
  Result<QSqlQuery> tables = connection.execute(
      "SELECT count(*), count(*) FILTER (WHERE c.relname = 'scantrove_schema')"
      " FROM pg_class c JOIN pg_namespace n ON n.oid = c.relnamespace"
      " WHERE n.nspname = current_schema() AND c.relkind IN ('r', 'p', 'v', 'm', 'f')");
  if (!tables) return fail(tables.error());
  if (!tables->next() || tables->value(0).toInt() == 0) return 0;
  const Error foreign{
      "The database " + connection.file() + " holds tables of another program.",
      "Give a database of its own to the " + std::string(kind.called) + ": createdb NAME makes one."};
  if (tables->value(1).toInt() == 0) return fail(foreign);
  Result<QSqlQuery> own = connection.execute("SELECT application_id, version FROM scantrove_schema");
  if (!own) return fail(own.error());
  if (!own->next() || own->value(0).toInt() != kind.application_id) return fail(foreign);
  const int version = own->value(1).toInt();
  if (version >= 1) return version;
  return fail(damagedDatabase(connection.file(), "its schema is version " + std::to_string(version)));
}

/// The schema's version, 0 for an empty file; changes nothing. One statement reads all numbers, so that they
/// are consistent while another process creates the catalogue.
Result<int> ownVersion(DatabaseConnection& connection, const FileKind& kind) {
  if (connection.isOnServer()) return versionOnServer(connection, kind);
  Result<QSqlQuery> query = connection.execute(
      "SELECT (SELECT user_version FROM pragma_user_version),"
      " (SELECT application_id FROM pragma_application_id), (SELECT count(*) FROM sqlite_master)");
  if (!query) return fail(query.error());
  if (!query->next()) return 0;
  const int version = query->value(0).toInt(), application = query->value(1).toInt();
  const bool has_tables = query->value(2).toInt() > 0;
  if (version == 0 && application == 0 && !has_tables) return 0;
  const std::string called(kind.called);
  if (application != kind.application_id) {
    return fail("The file " + connection.file() + " is a database of another program, not a Scantrove " +
                    called + ".",
                "Give another file name; a new " + called + " is created where there is no file.");
  }
  if (version < 1 || !has_tables) {
    return fail(damagedDatabase(connection.file(), "its schema is version " + std::to_string(version) +
                                                       (has_tables ? "" : " without tables")));
  }
  return version;
}

Result<void> apply(DatabaseConnection& connection, const Migration& step) {
  for (const QString& statement : statementsOf(step.sql)) {
    const QString text = inDialect(statement, connection.dialect());
    if (!text.isEmpty()) SCANTROVE_TRY(connection.execute(text));
  }
  SCANTROVE_TRY(connection.execute(
      "INSERT INTO schema_migrations (version, name, applied) VALUES (?, ?, ?)",
      {step.version, QString::fromUtf8(step.name.data(), static_cast<qsizetype>(step.name.size())),
       DatabaseConnection::now()}));
  const QString version = connection.isOnServer() ? QString("UPDATE scantrove_schema SET version = %1")
                                                  : QString("PRAGMA user_version = %1");
  SCANTROVE_TRY(connection.execute(version.arg(step.version)));
  return {};
}

/// What stands in the header of a file is a table on a server.
Result<void> createVersionTable(DatabaseConnection& connection, const FileKind& kind) {
  SCANTROVE_TRY(connection.execute(
      "CREATE TABLE scantrove_schema (application_id BIGINT NOT NULL, version BIGINT NOT NULL)"));
  SCANTROVE_TRY(connection.execute("INSERT INTO scantrove_schema (application_id, version) VALUES (?, 0)",
                                   {kind.application_id}));
  return {};
}

/// Refuses schema objects that no step creates: a view in place of a table may never end, and a trigger
/// changes unrelated data.
/// On a server only the database's owner can add them, and may have reasons to.
Result<void> checkTables(DatabaseConnection& connection, std::span<const Migration> steps) {
  if (connection.isOnServer()) return {};
  Result<QSqlQuery> strangers = connection.execute(
      "SELECT type, name FROM sqlite_master WHERE type IN ('view', 'trigger')"
      " OR sql LIKE 'CREATE VIRTUAL%' ORDER BY type = 'trigger' DESC, name");
  if (!strangers) return fail(strangers.error());
  while (strangers->next()) {
    const std::string type = strangers->value(0).toString().toStdString();
    const QString name = strangers->value(1).toString();
    const bool is_expected = std::ranges::any_of(steps, [&](const Migration& step) {
      const auto statements = statementsOf(step.sql);
      return std::ranges::any_of(statements, [&](const QString& statement) {
        return statement.startsWith("CREATE TABLE " + name + " ", Qt::CaseInsensitive);
      });
    });
    if (type != "trigger" && !is_expected) continue;  // harmless: nothing reads it
    return fail("The file " + connection.file() + " holds a " + (type == "trigger" ? type : "view") + " \"" +
                    name.left(kLongestName).toStdString() +
                    (type == "trigger" ? "\", which Scantrove never writes." : "\" in place of a table."),
                "It was changed by another program; use a copy from before that.");
  }
  return {};
}

/// ownVersion(), if this program supports it.
Result<int> knownVersion(DatabaseConnection& connection, const FileKind& kind,
                         std::span<const Migration> steps) {
  const int newest = newestOf(steps);
  Result<int> version = ownVersion(connection, kind);
  if (!version) return version;
  if (*version <= newest) {
    SCANTROVE_TRY(checkTables(connection, steps));
    return version;
  }
  return fail("The " + std::string(kind.called) + " " + connection.file() +
                  " was written by a newer Scantrove (its schema is version " + std::to_string(*version) +
                  ", this program knows " + std::to_string(newest) + ").",
              "Update Scantrove, or give another file name.");
}

}  // namespace

Result<int> versionToRead(DatabaseConnection& connection, const FileKind& kind,
                          std::span<const Migration> steps, int oldest) {
  Result<int> version = knownVersion(connection, kind, steps);
  if (!version || *version >= oldest) return version;
  const std::string called = "The " + std::string(kind.called) + " " + connection.file();
  if (*version == 0) return fail(called + " is empty.", "It was not written to its end.");
  return fail(
      called + " was written by an older Scantrove (its schema is version " + std::to_string(*version) + ").",
      "Open it once with a command that may write to it, which brings it up to date.");
}

Result<void> migrate(DatabaseConnection& connection, const FileKind& kind, std::span<const Migration> steps) {
  const int newest = newestOf(steps);
  const Result<int> version = knownVersion(connection, kind, steps);
  if (!version) return fail(version.error());
  SCANTROVE_TRY(connection.useWriteAheadLog());
  if (*version == newest) return {};
  return inTransaction(connection, [&]() -> Result<void> {
    const Result<int> current = ownVersion(connection, kind);  // another process may have migrated meanwhile
    if (!current) return fail(current.error());
    if (*current == 0 && connection.isOnServer()) SCANTROVE_TRY(createVersionTable(connection, kind));
    for (const Migration& step : steps) {
      if (step.version > *current) SCANTROVE_TRY(apply(connection, step));
    }
    return {};
  });
}

}  // namespace scantrove::schema
