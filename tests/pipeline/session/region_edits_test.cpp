// A person's operations while a scan runs.
#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <map>
#include <mutex>
#include <thread>

#include "core/scan/open_session.h"
#include "core/scan/scan_session.h"
#include "tests/support/qt_main_thread.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

/// Hears what a session says, and waits for it.
class Ear {
 public:
  void hear(const ScanEvent& event) {
    {
      const std::scoped_lock lock(mutex_);
      if (const auto* edited = std::get_if<Edited>(&event)) edits_.push_back(edited->regions);
      if (const auto* failed = std::get_if<EditFailed>(&event)) failures_.push_back(failed->error.message());
    }
    heard_.notify_all();
  }
  /// The regions of the n-th operation (from 1), empty if it failed or does not come.
  std::vector<RegionId> edit(std::size_t n) {
    std::unique_lock lock(mutex_);
    heard_.wait_for(lock, std::chrono::seconds(60), [&] { return edits_.size() >= n || !failures_.empty(); });
    return edits_.size() >= n ? edits_[n - 1] : std::vector<RegionId>{};
  }
  std::vector<std::string> failures() {
    const std::scoped_lock lock(mutex_);
    return failures_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable heard_;
  std::vector<std::vector<RegionId>> edits_;
  std::vector<std::string> failures_;
};

/// The regions that the newest snapshot shows, by how much of the image they fill, largest first.
std::vector<RegionId> regionsInView(ScanSession& session, int frames) {
  for (int i = 0; i < 1200; ++i) {
    const auto snapshot = session.snapshots().collect();
    if (!snapshot || snapshot->frames.read < frames || snapshot->regions.empty()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      continue;
    }
    std::map<int, int> pixels;
    for (const int region : cv::Mat_<int>(snapshot->regions)) ++pixels[region];
    pixels.erase(0);
    std::vector<std::pair<int, int>> sizes;
    for (const auto& [region, count] : pixels) sizes.emplace_back(-count, region);
    std::sort(sizes.begin(), sizes.end());
    std::vector<RegionId> regions;
    for (const auto& [count, region] : sizes) regions.push_back(RegionId{static_cast<std::uint32_t>(region)});
    return regions;
  }
  return {};
}

TEST(RegionEdits, HoldToTheEndOfTheScanAndInWhatIsKept) {
  const QtMainThread qt;
  const TemporaryFolder folder;
  Ear ear;
  std::vector<RegionId> joined, kept;
  {
    ScanSession session([&](const ScanEvent& event) { ear.hear(event); });
    ScanRequest request;
    request.source = "demo";
    request.source_options.frames = 40;
    request.output_folder = folder / "scan";
    request.database = (folder / "catalogue.sqlite").string();
    request.start_paused = true;
    session.start(request);
    for (int i = 0; i < 15; ++i) session.step();
    const std::vector<RegionId> regions = regionsInView(session, 15);
    ASSERT_GE(regions.size(), 5U);
    joined = {regions[2], regions[3]};
    Operation operation;
    operation.kind = OperationKind::join;
    operation.regions = joined;
    session.edit(operation);
    ASSERT_EQ(ear.edit(1), std::vector{joined[0]});
    operation = {};
    operation.regions = {regions[4]};
    operation.name = "a thing";
    session.edit(operation);
    ASSERT_EQ(ear.edit(2), std::vector{regions[4]});
    operation.name = "something else";
    session.edit(operation);
    ASSERT_FALSE(ear.edit(3).empty());
    session.edit(UndoEdit{});
    ASSERT_FALSE(ear.edit(4).empty());
    kept = {regions[4]};
    session.resume();
    session.wait();
    EXPECT_EQ(session.state(), ScanState::finished);
  }
  EXPECT_TRUE(ear.failures().empty());
  auto session = OpenSession::open(folder / "scan");
  ASSERT_TRUE(session) << session.error().message();
  EXPECT_EQ((*session)->frames().size(), 40U);
  EXPECT_EQ((*session)->noteOf(kept[0]).name, "a thing");
  const auto regions = (*session)->regions();
  ASSERT_TRUE(regions);
  for (const RegionSummary& region : *regions) EXPECT_NE(region.region, joined[1]);
  ASSERT_EQ((*session)->history().entries().size(), 3U);
  // What was done in the scan can be taken back later.
  ASSERT_TRUE((*session)->undo());
  ASSERT_TRUE((*session)->undo());
  EXPECT_FALSE((*session)->undo());
  const auto again = (*session)->regions();
  ASSERT_TRUE(again);
  EXPECT_TRUE(std::ranges::any_of(*again, [&](const auto& region) { return region.region == joined[1]; }));
}

TEST(RegionEdits, WhatCannotBeDoneIsSaidAndTheScanGoesOn) {
  const QtMainThread qt;
  const TemporaryFolder folder;
  Ear ear;
  ScanSession session([&](const ScanEvent& event) { ear.hear(event); });
  ScanRequest request;
  request.source = "demo";
  request.source_options.frames = 5;
  request.database = (folder / "catalogue.sqlite").string();
  request.start_paused = true;
  session.start(request);
  session.step();
  Operation operation;
  operation.regions = {RegionId{777}};
  operation.name = "x";
  session.edit(operation);
  EXPECT_TRUE(ear.edit(1).empty());
  session.resume();
  session.wait();
  EXPECT_EQ(session.state(), ScanState::finished);
  ASSERT_EQ(ear.failures().size(), 1U);
  EXPECT_NE(ear.failures()[0].find("777"), std::string::npos);
}

}  // namespace
}  // namespace scantrove::test
