#include "core/session/recording_rows.h"

#include <cmath>

#include "core/session/checked_rows.h"
#include "core/session/row_checks.h"

namespace scantrove::rows {
namespace {

/// A recording that begins later than the scan ends is not shifted back.
constexpr Bounds kIndexShifts{0, 0x7fffffff};

}  // namespace

Result<void> writeRecordings(DatabaseConnection& database, const std::vector<SavedRecording>& recordings) {
  for (const SavedRecording& one : recordings) {
    SCANTROVE_TRY(put(database, "recordings",
                      {{"first_frame", one.first_frame},
                       {"source", QString::fromStdString(one.source)},
                       {"index_shift", one.index_shift},
                       {"time_shift_s", one.time_shift_s}}));
  }
  return recordings.empty() ? Result<void>() : seal(database, "recordings");
}

Result<std::vector<SavedRecording>> readRecordings(DatabaseConnection& database,
                                                   std::vector<std::string>& damages) {
  Result<QSqlQuery> rows = database.execute(
      "SELECT first_frame, source, index_shift, time_shift_s, row_check FROM recordings ORDER BY "
      "first_frame");
  if (!rows) return fail(rows.error());
  RowAudit audit(*rows);
  std::vector<SavedRecording> recordings;
  int bad = 0;
  while (rows->next()) {
    SavedRecording one{rows->value(0).toInt(), rows->value(1).toString().toStdString(),
                       rows->value(2).toInt(), rows->value(3).toDouble()};
    const bool is_recording = audit.take(*rows) && integerAt(*rows, 0, kCounts) &&
                              integerAt(*rows, 2, kIndexShifts) && std::isfinite(one.time_shift_s);
    if (is_recording) recordings.push_back(std::move(one));
    bad += is_recording ? 0 : 1;
  }
  if (bad > 0)
    damages.push_back(std::to_string(bad) + " recordings of the session in " + database.file() +
                      " cannot be read and are left out.");
  const Result<std::string> rest = audit.close(database, "recordings", "recordings", *rows);
  if (!rest) return fail(rest.error());
  if (!rest->empty()) damages.push_back(*rest);
  return recordings;
}

}  // namespace scantrove::rows
