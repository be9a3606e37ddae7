#pragma once
#include <functional>

#include "app/progress_line.h"
#include "core/base/result.h"
#include "core/scan/scan_report.h"
#include "core/scan/scan_request.h"
#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// Runs `request` until its end or the first Ctrl+C, with progress on stderr. Ctrl+C during the refinement
/// skips the rest of it. Any other signal, or Ctrl+C during a recording, skips the refinement completely.
/// `watch` gets the newest snapshots, without point cloud. Main thread; blocks. Error: the scan could not
/// start or continue.
[[nodiscard]] Result<ScanReport> runToEnd(ScanRequest request,
                                          const std::function<void(const ScanSnapshot&)>& watch = {});

}  // namespace scantrove
