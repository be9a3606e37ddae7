#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/saved_scan.h"

/// The table `operations` of a session: the history of edits.
namespace scantrove::rows {

/// Requires a transaction.
[[nodiscard]] Result<void> writeOperations(DatabaseConnection& database,
                                           const std::vector<OperationLog::Entry>& operations);

/// Fills scan.operations, in order.
[[nodiscard]] Result<void> readOperations(DatabaseConnection& database, SavedScan& scan,
                                          std::vector<std::string>& damages);

}  // namespace scantrove::rows
