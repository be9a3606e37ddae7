#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/saved_scan.h"

/// The tables `frames` and `key_frames` of a session.
namespace scantrove::rows {

/// Requires a transaction.
[[nodiscard]] Result<void> writeFrames(DatabaseConnection& database, const SavedDelta& delta);

/// Fills scan.frames and scan.key_frames, in order of number.
[[nodiscard]] Result<void> readFrames(DatabaseConnection& database, SavedScan& scan,
                                      std::vector<std::string>& damages);

}  // namespace scantrove::rows
