#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/saved_scan.h"

/// The table `mask_corrections` of a session: what a person painted in images.
namespace scantrove::rows {

/// Requires a transaction.
[[nodiscard]] Result<void> writeMasks(DatabaseConnection& database,
                                      const std::vector<OperationLog::Entry>& operations);

/// Adds the painted pixels to scan.operations. An operation whose row is missing or damaged has none: it can
/// be undone, but corrects no image.
[[nodiscard]] Result<void> readMasks(DatabaseConnection& database, SavedScan& scan,
                                     std::vector<std::string>& damages);

}  // namespace scantrove::rows
