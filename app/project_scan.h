#pragma once
#include "app/recording_outcome.h"
#include "core/project/project.h"
#include "core/scan/scan_request.h"

namespace scantrove {

/// Scans the recording of `request` into `project`: skips it if it was scanned to its end before or if
/// another program has claimed it, continues a stopped scan, else begins a new one. Main thread; blocks.
[[nodiscard]] RecordingOutcome scanIntoProject(const Project& project, const ScanRequest& request);

}  // namespace scantrove
