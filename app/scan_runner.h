#pragma once
#include <functional>

#include "app/progress_line.h"
#include "core/base/result.h"
#include "core/scan/scan_report.h"
#include "core/scan/scan_request.h"
#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// Runs `request` to its end, or to the first Ctrl+C, with progress on stderr. Ctrl+C while objects are
/// refined skips the rest of that; one that breaks a recording off, or any other signal, skips all of it.
/// `watch` sees each snapshot that was not overtaken by a newer one; they are without cloud. Main thread;
/// blocks. Error: why the scan could not start or go on.
[[nodiscard]] Result<ScanReport> runToEnd(ScanRequest request,
                                          const std::function<void(const ScanSnapshot&)>& watch = {});

}  // namespace scantrove
