#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/saved_scan.h"

/// The table `estimates` of a session: labels at estimated places (schema/007_estimates.sql).
namespace scantrove::rows {

/// Requires a transaction. A brick without cells loses its row.
[[nodiscard]] Result<void> writeEstimates(DatabaseConnection& database,
                                          const std::vector<SavedEstimates>& estimates);
/// In order of the positions; malformed rows are left out, with a sentence.
[[nodiscard]] Result<std::vector<SavedEstimates>> readEstimates(DatabaseConnection& database,
                                                                std::vector<std::string>& damages);

}  // namespace scantrove::rows
