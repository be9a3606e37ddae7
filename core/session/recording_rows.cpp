#include "core/session/recording_rows.h"

#include <cmath>

#include "core/session/row_checks.h"

namespace scantrove::rows {
namespace {

/// A recording that begins later than the scan ends is not shifted back.
constexpr Bounds kIndexShifts{0, 0x7fffffff};

}  // namespace

Result<void> writeRecordings(DatabaseConnection& database, const std::vector<SavedRecording>& recordings) {
  for (const SavedRecording& one : recordings) {
    SCANTROVE_TRY(database.execute(
        "INSERT OR REPLACE INTO recordings (first_frame, source, index_shift, time_shift_s) VALUES (?, ?, ?, "
        "?)",
        {one.first_frame, QString::fromStdString(one.source), one.index_shift, one.time_shift_s}));
  }
  return {};
}

Result<std::vector<SavedRecording>> readRecordings(DatabaseConnection& database,
                                                   std::vector<std::string>& damages) {
  Result<QSqlQuery> rows = database.execute(
      "SELECT first_frame, source, index_shift, time_shift_s FROM recordings ORDER BY first_frame");
  if (!rows) return fail(rows.error());
  std::vector<SavedRecording> recordings;
  int bad = 0;
  while (rows->next()) {
    SavedRecording one{rows->value(0).toInt(), rows->value(1).toString().toStdString(),
                       rows->value(2).toInt(), rows->value(3).toDouble()};
    const bool is_recording =
        integerAt(*rows, 0, kCounts) && integerAt(*rows, 2, kIndexShifts) && std::isfinite(one.time_shift_s);
    if (is_recording) recordings.push_back(std::move(one));
    bad += is_recording ? 0 : 1;
  }
  if (bad > 0)
    damages.push_back(std::to_string(bad) + " recordings of the session in " + database.file() +
                      " cannot be read and are left out.");
  return recordings;
}

}  // namespace scantrove::rows
