#pragma once
#include <filesystem>

#include "core/base/result.h"
#include "core/database/database_connection.h"

namespace scantrove {

/// Error: a user has labelled the session, so no new scan may replace it.
[[nodiscard]] Result<void> checkIsUnlabeled(DatabaseConnection& database,
                                            const std::filesystem::path& folder);

/// In a transaction: resets a session to its initial state. Its files become outdated.
[[nodiscard]] Result<void> clearSession(DatabaseConnection& database);

}  // namespace scantrove
