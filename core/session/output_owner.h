#pragma once
#include <filesystem>

#include "core/base/result.h"

namespace scantrove {

/// Whether an earlier scan of this program wrote `folder`: it holds a session, or a report of ours.
[[nodiscard]] bool holdsEarlierScan(const std::filesystem::path& folder);

/// What a scan writes beside its session.
struct ScanResults {
  bool files = true;  ///< trajectory, cloud, label map, report
  bool label_images = false;
};

/// What earlier scans wrote in `folder`, as its session and its report have it.
[[nodiscard]] ScanResults ownResults(const std::filesystem::path& folder);

/// Error: a new scan into `folder` would mix with or replace files that no scan of ours wrote there (a
/// recording's trajectory, a person's pictures); names the first such file and what to do.
[[nodiscard]] Result<void> checkHoldsOnlyOurs(const std::filesystem::path& folder,
                                              const ScanResults& planned);

/// The same for a scan that continues the session in `folder`.
[[nodiscard]] Result<void> checkResultsAreOurs(const std::filesystem::path& folder,
                                               const ScanResults& planned);

}  // namespace scantrove
