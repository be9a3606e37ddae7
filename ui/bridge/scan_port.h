#pragma once
#include <functional>
#include <memory>

#include "core/base/latest_value.h"
#include "core/scan/scan_command.h"
#include "core/scan/scan_event.h"
#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// The window's access to a ScanWorker. The worker ends when the last copy is destroyed. Tests use a scripted
/// worker instead.
struct ScanPort {
  std::function<void(ScanCommand command)> post;
  std::shared_ptr<LatestValue<ScanSnapshot>> snapshots;
};

/// Creates a worker that calls `listener` with its events, on the worker's thread.
using ScanPortFactory = std::function<ScanPort(ScanListener listener)>;

/// Creates a ScanWorker.
[[nodiscard]] ScanPort startScanWorker(ScanListener listener);

}  // namespace scantrove
