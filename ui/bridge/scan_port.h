#pragma once
#include <functional>
#include <memory>

#include "core/base/latest_value.h"
#include "core/scan/scan_command.h"
#include "core/scan/scan_event.h"
#include "core/scan/scan_snapshot.h"

namespace scantrove {

/// What the window has of a ScanWorker, which ends with the last copy. The window's tests put a script behind
/// it.
struct ScanPort {
  std::function<void(ScanCommand command)> post;
  std::shared_ptr<LatestValue<ScanSnapshot>> snapshots;
};

/// Makes a worker whose events go to `listener`, on the worker's thread.
using ScanPortFactory = std::function<ScanPort(ScanListener listener)>;

/// The real one.
[[nodiscard]] ScanPort startScanWorker(ScanListener listener);

}  // namespace scantrove
