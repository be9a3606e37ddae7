#include "ui/bridge/scan_port.h"

#include <utility>

#include "core/scan/scan_worker.h"

namespace scantrove {

ScanPort startScanWorker(ScanListener listener) {
  const auto worker = std::make_shared<ScanWorker>(std::move(listener), Niceness::scan_beside_window);
  return {[worker](ScanCommand command) { worker->post(std::move(command)); },
          {worker, &worker->snapshots()}};
}

}  // namespace scantrove
