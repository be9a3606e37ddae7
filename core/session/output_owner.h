#pragma once
#include <filesystem>

#include "core/base/result.h"

namespace scantrove {

/// Whether an earlier scan of this program wrote `folder`: it contains a session, or a report of ours.
[[nodiscard]] bool holdsEarlierScan(const std::filesystem::path& folder);

/// What a scan writes beside its session.
struct ScanResults {
  bool files = true;  ///< trajectory, cloud, label map, report
  bool label_images = false;
};

/// The outputs that earlier scans wrote in `folder`, according to its session and report.
[[nodiscard]] ScanResults ownResults(const std::filesystem::path& folder);

/// Error: a new scan into `folder` would mix with or replace files that no scan of ours wrote (a
/// recording's trajectory, a user's pictures). Names the first such file and what to do.
[[nodiscard]] Result<void> checkHoldsOnlyOurs(const std::filesystem::path& folder,
                                              const ScanResults& planned);

/// The same for a scan that continues the session in `folder`.
[[nodiscard]] Result<void> checkResultsAreOurs(const std::filesystem::path& folder,
                                               const ScanResults& planned);

}  // namespace scantrove
