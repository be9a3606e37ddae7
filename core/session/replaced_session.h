#pragma once
#include <filesystem>

#include "core/base/result.h"
#include "core/database/database_connection.h"

namespace scantrove {

/// Error: somebody has labelled the session, so that no new scan may take its place.
[[nodiscard]] Result<void> checkIsUnlabeled(DatabaseConnection& database,
                                            const std::filesystem::path& folder);

/// In a transaction: makes a session what it was when it was made. Its files are outdated from then on.
[[nodiscard]] Result<void> clearSession(DatabaseConnection& database);

}  // namespace scantrove
