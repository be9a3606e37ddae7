#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/saved_scan.h"

/// The tables `frames` and `key_frames` of a session.
namespace scantrove::rows {

/// To be called in a transaction.
[[nodiscard]] Result<void> writeFrames(DatabaseConnection& database, const SavedDelta& delta);

/// Fills scan.frames and scan.key_frames, by number.
[[nodiscard]] Result<void> readFrames(DatabaseConnection& database, SavedScan& scan,
                                      std::vector<std::string>& damages);

}  // namespace scantrove::rows
