#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/saved_scan.h"

/// The tables of a session but for `pages` (schema/001_session.sql).
namespace scantrove::rows {

/// Requires a transaction.
[[nodiscard]] Result<void> write(DatabaseConnection& database, const SavedDelta& delta);

/// All rows; malformed ones are left out, with a sentence for each kind.
[[nodiscard]] Result<SavedScan> read(DatabaseConnection& database, std::vector<std::string>& damages);

/// None: nothing was stored, or it is damaged.
[[nodiscard]] Result<std::optional<SavedCamera>> readCamera(DatabaseConnection& database);

}  // namespace scantrove::rows
