#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/saved_scan.h"

/// The tables `facts` and `fact_copies` of a session: its metadata by name, twice.
namespace scantrove::rows {

/// To be called in a transaction.
[[nodiscard]] Result<void> writeMetadata(DatabaseConnection& database, const SessionMetadata& metadata);

/// What is damaged or gone is taken from its copy.
[[nodiscard]] Result<SessionMetadata> readMetadata(DatabaseConnection& database,
                                                   std::vector<std::string>& damages);

}  // namespace scantrove::rows
