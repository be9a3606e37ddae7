#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/saved_scan.h"

/// The tables `fragments`, `regions` and `borders` of a session.
namespace scantrove::rows {

/// Requires a transaction.
[[nodiscard]] Result<void> writeRegions(DatabaseConnection& database, const SavedDelta& delta);

/// Fills scan.fragments, scan.regions and scan.borders, in order of number.
[[nodiscard]] Result<void> readRegions(DatabaseConnection& database, SavedScan& scan,
                                       std::vector<std::string>& damages);

}  // namespace scantrove::rows
