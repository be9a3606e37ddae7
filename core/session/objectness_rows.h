#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/saved_scan.h"

/// The table `objectness` of a session (schema/008_objectness.sql).
namespace scantrove::rows {

/// Replaces all rows. Requires a transaction.
[[nodiscard]] Result<void> writeObjectness(DatabaseConnection& database, const SavedObjectness& objectness);
/// Malformed rows are left out, with a sentence.
[[nodiscard]] Result<SavedObjectness> readObjectness(DatabaseConnection& database,
                                                     std::vector<std::string>& damages);

}  // namespace scantrove::rows
