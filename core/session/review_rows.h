#pragma once
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/database/database_connection.h"
#include "core/session/saved_scan.h"

/// The table `frame_reviews` of a session: a person's reviews of key frames.
namespace scantrove::rows {

/// Requires a transaction.
[[nodiscard]] Result<void> writeReviews(DatabaseConnection& database,
                                        const std::vector<OperationLog::Entry>& operations);

/// Adds key frames and states to the reviews of scan.operations. An operation whose row is missing or damaged
/// has none: it can be undone, but reviews no frame.
[[nodiscard]] Result<void> readReviews(DatabaseConnection& database, SavedScan& scan,
                                       std::vector<std::string>& damages);

/// The current states of all key frames with a pose, without reading the history. A session of an earlier
/// version has open ones only.
[[nodiscard]] Result<ReviewCounts> countReviews(DatabaseConnection& database);

}  // namespace scantrove::rows
