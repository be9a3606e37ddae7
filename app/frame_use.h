#pragma once
#include "core/base/result.h"
#include "core/capture/frame_source.h"
#include "core/scan/scan_report.h"

namespace scantrove {

/// Error: no frame of the scan was added to the map. The message gives the likely reason (no depth, wrong
/// depth scale); to find it, the first frames of a recording are read again. A scan that was stopped before
/// its first frame is no error.
[[nodiscard]] Result<void> checkFramesWereUsed(const ScanReport& report, const SourceOptions& options,
                                               bool is_resumed = false);

}  // namespace scantrove
