#pragma once
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/scan/scan_worker.h"
#include "tests/support/qt_main_thread.h"

namespace scantrove::test {

/// How a scan ended and what it said on the way.
struct ScanEnding {
  std::optional<ScanReport> report;  ///< empty: it failed
  std::string error;
  std::vector<FrameSkipped> skipped;
  std::vector<std::string> added;       ///< names
  std::vector<std::string> recognized;  ///< names
  std::vector<ObjectId> merged;         ///< objects that became part of others
  std::vector<RefinementStepped> refinement;
  std::vector<ObjectId> removed;  ///< that turned out not to be what their views show
};

/// Runs one scan to its end through the worker that window and command line use.
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
