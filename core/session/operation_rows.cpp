#include "core/session/operation_rows.h"

#include <array>
#include <optional>
#include <utility>

#include "core/session/operation_json.h"
#include "core/session/row_checks.h"
#include "core/session/table_reading.h"

namespace scantrove::rows {
namespace {

using LogState = OperationLog::State;
constexpr std::array<std::pair<LogState, const char*>, 3> kLogStates{
    {{LogState::done, "done"}, {LogState::undone, "undone"}, {LogState::superseded, "superseded"}}};

QString wordFor(LogState state) {
  for (const auto& [one, word] : kLogStates) {
    if (one == state) return word;
  }
  return "";
}

std::optional<LogState> logStateFrom(const std::string& word) {
  for (const auto& [state, known] : kLogStates) {
    if (word == known) return state;
  }
  return std::nullopt;
}

std::optional<OperationLog::Entry> operationFrom(const QSqlQuery& row) {
  const auto state = logStateFrom(text(row, 1));
  auto operation = operationFromJson(text(row, 2));
  auto effect = effectFromJson(text(row, 3));
  if (!integerAt(row, 0, {1, kCounts.most}) || !state || !operation || !effect) return std::nullopt;
  if (!isPlausible(*operation) || !isPlausible(*effect)) return std::nullopt;
  return OperationLog::Entry{row.value(0).toInt(), std::move(*operation), std::move(*effect), *state};
}

}  // namespace

Result<void> writeOperations(DatabaseConnection& database,
                             const std::vector<OperationLog::Entry>& operations) {
  for (const OperationLog::Entry& entry : operations) {
    const std::array<Column, 4> columns{{{"number", entry.number},
                                         {"state", wordFor(entry.state)},
                                         {"operation", text(operationToJson(entry.operation))},
                                         {"effect", text(effectToJson(entry.effect))}}};
    // An undo keeps the time of the operation, which is not part of the checksum. The number may belong to
    // a damaged row that was left out.
    SCANTROVE_TRY(database.execute(
        "INSERT INTO operations (number, state, operation, effect, row_check, done) VALUES (?, ?, ?, ?, ?, ?)"
        " ON CONFLICT (number) DO UPDATE SET state = excluded.state, operation = excluded.operation,"
        " effect = excluded.effect, row_check = excluded.row_check",
        {columns[0].value, columns[1].value, columns[2].value, columns[3].value, checkOf(columns),
         DatabaseConnection::now()}));
  }
  return operations.empty() ? Result<void>() : seal(database, "operations");
}

Result<void> readOperations(DatabaseConnection& database, SavedScan& scan,
                            std::vector<std::string>& damages) {
  return readTable(
      database,
      {"operations", "SELECT number, state, operation, effect, row_check FROM operations ORDER BY number",
       "operations"},
      damages, scan.operations, operationFrom);
}

}  // namespace scantrove::rows
