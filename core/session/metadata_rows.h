#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/saved_scan.h"

/// The tables `facts` and `fact_copies` of a session: two copies of its metadata by name.
namespace scantrove::rows {

/// Requires a transaction.
[[nodiscard]] Result<void> writeMetadata(DatabaseConnection& database, const SessionMetadata& metadata);

/// Damaged or missing entries are read from their copy.
[[nodiscard]] Result<SessionMetadata> readMetadata(DatabaseConnection& database,
                                                   std::vector<std::string>& damages);

}  // namespace scantrove::rows
