#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/saved_scan.h"

/// The table `recordings` of a session (schema/006_recordings.sql).
namespace scantrove::rows {

/// Requires a transaction.
[[nodiscard]] Result<void> writeRecordings(DatabaseConnection& database,
                                           const std::vector<SavedRecording>& recordings);

/// In order; malformed rows are left out, with a sentence.
[[nodiscard]] Result<std::vector<SavedRecording>> readRecordings(DatabaseConnection& database,
                                                                 std::vector<std::string>& damages);

}  // namespace scantrove::rows
