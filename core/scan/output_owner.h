#pragma once
#include <filesystem>

#include "core/base/result.h"

namespace scantrove {

/// Whether an earlier scan of this program wrote `folder`: it holds a session, or a report of ours.
[[nodiscard]] bool holdsEarlierScan(const std::filesystem::path& folder);

/// Whether `folder` holds the report that a scan of this program writes beside its results.
[[nodiscard]] bool holdsOurReport(const std::filesystem::path& folder);

/// Error: a new scan into `folder` would mix with or replace files that no scan of ours wrote there (a
/// recording's trajectory, a person's pictures); names the first such file and what to do.
[[nodiscard]] Result<void> checkHoldsOnlyOurs(const std::filesystem::path& folder);

}  // namespace scantrove
