#pragma once
#include "core/base/result.h"
#include "core/capture/frame_source.h"
#include "core/scan/scan_report.h"

namespace scantrove {

/// Error: no frame of the scan came into the map, with the likely reason (no depth, a wrong depth scale), for
/// which a recording's first frames are read again. A scan that was stopped before its first frame is none.
[[nodiscard]] Result<void> checkFramesWereUsed(const ScanReport& report, const SourceOptions& options,
                                               bool is_resumed = false);

}  // namespace scantrove
