#include "core/session/recording_rows.h"

#include <cmath>
#include <optional>
#include <utility>

#include "core/session/row_checks.h"
#include "core/session/table_reading.h"

namespace scantrove::rows {
namespace {

/// The offset cannot be negative.
constexpr Bounds kIndexShifts{0, 0x7fffffff};

std::optional<SavedRecording> recordingFrom(const QSqlQuery& row) {
  SavedRecording one{row.value(0).toInt(), text(row, 1), row.value(2).toInt(), row.value(3).toDouble()};
  const bool is_recording =
      integerAt(row, 0, kCounts) && integerAt(row, 2, kIndexShifts) && std::isfinite(one.time_shift_s);
  return is_recording ? std::optional(std::move(one)) : std::nullopt;
}

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
  std::vector<SavedRecording> recordings;
  SCANTROVE_TRY(readTable(database,
                          {"recordings",
                           "SELECT first_frame, source, index_shift, time_shift_s, row_check FROM recordings"
                           " ORDER BY first_frame",
                           "recordings"},
                          damages, recordings, recordingFrom));
  return recordings;
}

}  // namespace scantrove::rows
