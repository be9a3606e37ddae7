// Joins of regions in a running scan merge their objects, and the undo parts them.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "core/catalogue/object_database.h"
#include "core/scan/scan_worker.h"
#include "tests/support/qt_main_thread.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

/// Waits until the condition is fulfilled. False: it is not within a minute.
bool isSoon(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (std::chrono::steady_clock::now() < end) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return condition();
}

TEST(RunningJoins, NamedObjectsMerge_AndPartWithTheUndo) {
  const QtMainThread qt;
  const TemporaryFolder folder;
  std::atomic<int> edits = 0;
  const std::string catalogue = (folder / "catalogue.sqlite").string();
  std::vector<RegionId> pair;
  std::vector<ObjectId> objects;
  ScanWorker worker([&](const ScanEvent& event) { edits += std::holds_alternative<Edited>(event) ? 1 : 0; });
  ScanRequest request;
  request.source = "demo";
  request.source_options.frames = 44;
  request.output_folder = folder / "scan";
  request.database = catalogue;
  request.start_paused = true;
  request.skip_refinement = true;
  worker.post(StartScan{request});
  for (int i = 0; i < 36; ++i) worker.post(StepScan{});
  std::shared_ptr<const ScanSnapshot> snapshot;
  ASSERT_TRUE(isSoon([&] {
    if (auto newer = worker.snapshots().collect()) snapshot = std::move(newer);
    return snapshot != nullptr && snapshot->frames.read >= 36;
  }));
  ASSERT_NE(snapshot->region_infos, nullptr);
  for (const RegionInfo& info : *snapshot->region_infos) {
    if (!info.label || !info.label->object || pair.size() == 2) continue;
    if (!objects.empty() && info.label->object == objects.front()) continue;  // a part of the same object
    pair.push_back(info.region);
    objects.push_back(info.label->object);
  }
  ASSERT_EQ(pair.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    Operation name;
    name.kind = OperationKind::name;
    name.regions = {pair[i]};
    name.name = i == 0 ? "left thing" : "right thing";
    worker.post(EditRegions{name});
  }
  Operation join;
  join.kind = OperationKind::join;
  join.regions = pair;
  worker.post(EditRegions{join});
  ASSERT_TRUE(isSoon([&] { return edits == 3; }));
  const auto mergeRoot = [&](ObjectId object) {
    return ObjectDatabase::open(catalogue).value()->mergeRoot(object).value();
  };
  EXPECT_TRUE(isSoon([&] { return mergeRoot(objects[0]) == mergeRoot(objects[1]); }))
      << "also while the scan is paused";
  worker.post(EditRegions{UndoEdit{}});
  EXPECT_TRUE(isSoon([&] { return mergeRoot(objects[0]) != mergeRoot(objects[1]); }));
  worker.post(ResumeScan{});
  worker.wait();
  ASSERT_EQ(worker.state(), ScanState::finished);
  const auto database = ObjectDatabase::open(catalogue);
  ASSERT_TRUE(database);
  EXPECT_EQ((*database)->object(objects[0]).value().name, "left thing");
  EXPECT_EQ((*database)->object(objects[1]).value().name, "right thing");
}

}  // namespace
}  // namespace scantrove::test
