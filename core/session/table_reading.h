#pragma once
#include <QSqlQuery>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/checked_rows.h"

/// Reads whole tables of a session. Malformed rows, and rows that do not match their checksum, are left out
/// with a sentence for each kind.
namespace scantrove::rows {

[[nodiscard]] inline QString text(const std::string& value) { return QString::fromStdString(value); }
[[nodiscard]] inline std::string text(const QSqlQuery& row, int column) {
  return row.value(column).toString().toStdString();
}

/// A table to read.
struct Reading {
  const char* table;
  const char* sql;
  const char* called;  ///< in sentences
};

/// take(row) returns false for a malformed row.
template <class Take>
[[nodiscard]] Result<void> readRows(DatabaseConnection& database, const Reading& reading,
                                    std::vector<std::string>& damages, Take&& take) {
  Result<QSqlQuery> rows = database.execute(reading.sql);
  if (!rows) return fail(rows.error());
  RowAudit audit(*rows);
  int bad = 0;
  while (rows->next()) bad += audit.take(*rows) && take(*rows) ? 0 : 1;
  if (bad > 0)
    damages.push_back(std::to_string(bad) + " " + reading.called + " of the session in " + database.file() +
                      " cannot be read and are left out.");
  const Result<std::string> rest = audit.close(database, reading.table, reading.called, *rows);
  if (!rest) return fail(rest.error());
  if (!rest->empty()) damages.push_back(*rest);
  return {};
}

/// All rows that `from` converts.
template <class Row>
[[nodiscard]] Result<void> readTable(DatabaseConnection& database, const Reading& reading,
                                     std::vector<std::string>& damages, std::vector<Row>& list,
                                     std::optional<Row> (*from)(const QSqlQuery&)) {
  return readRows(database, reading, damages, [&list, from](const QSqlQuery& row) {
    std::optional<Row> read = from(row);
    if (read) list.push_back(std::move(*read));
    return read.has_value();
  });
}

}  // namespace scantrove::rows
