#include "core/catalog/migrations.h"

#include <QString>
#include <QVariant>
#include <string>
#include <vector>

#include "core/catalog/database_connection.h"
#include "core/catalog/transaction.h"

namespace scantrove::schema {
namespace {

constexpr int kApplicationId = 1399025268;  // "Scnt", as in 001_initial.sql

Result<int> readNumber(DatabaseConnection& connection, const char* sql) {
  Result<QSqlQuery> query = connection.execute(sql);
  if (!query) return fail(query.error());
  return query->next() ? query->value(0).toInt() : 0;
}

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

Result<int> ownVersion(DatabaseConnection& connection) {
  const Result<int> version = readNumber(connection, "PRAGMA user_version");
  if (!version) return version;
  const Result<int> application = readNumber(connection, "PRAGMA application_id");
  if (!application) return application;
  const Result<int> tables = readNumber(connection, "SELECT count(*) FROM sqlite_master");
  if (!tables) return tables;
  const bool is_empty = *version == 0 && *application == 0 && *tables == 0;
  if (!is_empty && *application != kApplicationId) {
    return fail(
        "The file " + connection.file() + " is a database of another program, not a Scantrove catalogue.",
        "Give another file name; a new catalogue is created where there is no file.");
  }
  return version;
}

Result<void> apply(DatabaseConnection& connection, const Migration& step) {
  for (const QString& statement : statementsOf(step.sql)) {
    const Result<QSqlQuery> done = connection.execute(statement);
    if (!done) return fail(done.error());
  }
  const Result<QSqlQuery> noted = connection.execute(
      "INSERT INTO schema_migrations (version, name, applied) VALUES (?, ?, ?)",
      {step.version, QString::fromUtf8(step.name.data(), static_cast<qsizetype>(step.name.size())),
       DatabaseConnection::now()});
  if (!noted) return fail(noted.error());
  const Result<QSqlQuery> versioned =
      connection.execute(QString("PRAGMA user_version = %1").arg(step.version));
  if (!versioned) return fail(versioned.error());
  return {};
}

}  // namespace

Result<void> migrate(DatabaseConnection& connection, std::span<const Migration> steps) {
  const Result<int> version = ownVersion(connection);
  if (!version) return fail(version.error());
  const int newest = steps.empty() ? 0 : steps.back().version;
  if (*version > newest) {
    return fail("The catalogue " + connection.file() +
                    " was written by a newer Scantrove (its schema is version " + std::to_string(*version) +
                    ", this program knows " + std::to_string(newest) + ").",
                "Update Scantrove, or give another file name.");
  }
  if (*version == newest) return {};
  return inTransaction(connection, [&]() -> Result<void> {
    const Result<int> current = ownVersion(connection);  // another process may have been faster
    if (!current) return fail(current.error());
    for (const Migration& step : steps) {
      if (step.version > *current) SCANTROVE_TRY(apply(connection, step));
    }
    return {};
  });
}

}  // namespace scantrove::schema
