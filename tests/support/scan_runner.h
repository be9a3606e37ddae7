#pragma once
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scan/scan_worker.h"
#include "tests/support/qt_main_thread.h"

namespace scantrove::test {

/// The result of a scan and its events.
struct ScanEnding {
  std::optional<ScanReport> report;  ///< empty: it failed
  std::string error;
  std::vector<FrameSkipped> skipped;
  std::vector<std::string> added;       ///< names
  std::vector<std::string> recognized;  ///< names
  std::vector<ObjectId> merged;         ///< objects merged into others
  std::vector<RefinementStepped> refinement;
  std::vector<ObjectId> removed;  ///< objects dropped because their views do not show them
};

/// Runs a scan to its end with the ScanWorker of window and command line.
inline ScanEnding runScan(ScanRequest request) {
  ScanEnding ending;
  const QtMainThread qt;
  ScanWorker worker([&](const ScanEvent& event) {  // read only after wait(): no lock needed
    if (const auto* finished = std::get_if<ScanFinished>(&event)) ending.report = finished->report;
    if (const auto* failed = std::get_if<ScanFailed>(&event)) ending.error = failed->error.message();
    if (const auto* skipped = std::get_if<FrameSkipped>(&event)) ending.skipped.push_back(*skipped);
    if (const auto* added = std::get_if<ObjectAdded>(&event)) ending.added.push_back(added->name);
    if (const auto* known = std::get_if<ObjectRecognized>(&event)) ending.recognized.push_back(known->name);
    if (const auto* step = std::get_if<RefinementStepped>(&event)) ending.refinement.push_back(*step);
    if (const auto* removed = std::get_if<ObjectRemoved>(&event)) ending.removed.push_back(removed->object);
    if (const auto* merged = std::get_if<ObjectsMerged>(&event))
      ending.merged.insert(ending.merged.end(), merged->from.begin(), merged->from.end());
  });
  worker.post(StartScan{std::move(request)});
  worker.wait();
  return ending;
}

}  // namespace scantrove::test
