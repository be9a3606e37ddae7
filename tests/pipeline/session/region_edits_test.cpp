// A user's operations during a scan.
#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <map>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "core/catalogue/object_database.h"
#include "core/scan/scan_worker.h"
#include "core/session/open_session.h"
#include "core/session/session_catalogue.h"
#include "tests/support/qt_main_thread.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {
namespace {

/// Collects the results of edits; waits for them.
class EditLog {
 public:
  void add(const ScanEvent& event) {
    {
      const std::scoped_lock lock(mutex_);
      if (const auto* edited = std::get_if<Edited>(&event)) edits_.push_back(edited->regions);
      if (const auto* failed = std::get_if<EditFailed>(&event)) failures_.push_back(failed->error.message());
    }
    arrived_.notify_all();
  }
  /// The regions of the n-th operation (from 1); empty: an operation failed, or it does not come.
  std::vector<RegionId> edit(std::size_t n) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, std::chrono::seconds(60),
                      [&] { return edits_.size() >= n || !failures_.empty(); });
    return edits_.size() >= n ? edits_[n - 1] : std::vector<RegionId>{};
  }
  std::vector<std::string> failures() {
    const std::scoped_lock lock(mutex_);
    return failures_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<std::vector<RegionId>> edits_;
  std::vector<std::string> failures_;
};

/// The next snapshot after at least `frames` frames; null: it does not come.
std::shared_ptr<const ScanSnapshot> snapshotAfter(ScanWorker& worker, int frames) {
  for (int i = 0; i < 1200; ++i) {
    auto snapshot = worker.snapshots().collect();
    if (snapshot && snapshot->frames.read >= frames && !snapshot->regions.empty()) return snapshot;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return nullptr;
}

/// The regions in a snapshot, by their pixels, largest first.
std::vector<RegionId> regionsIn(const ScanSnapshot& snapshot) {
  std::map<int, int> pixels;
  for (const int region : cv::Mat_<int>(snapshot.regions)) ++pixels[region];
  pixels.erase(0);
  std::vector<std::pair<int, int>> sizes;
  for (const auto& [region, count] : pixels) sizes.emplace_back(-count, region);
  std::sort(sizes.begin(), sizes.end());
  std::vector<RegionId> regions;
  for (const auto& [count, region] : sizes) regions.push_back(RegionId{static_cast<std::uint32_t>(region)});
  return regions;
}

std::vector<RegionId> regionsInView(ScanWorker& worker, int frames) {
  const auto snapshot = snapshotAfter(worker, frames);
  return snapshot ? regionsIn(*snapshot) : std::vector<RegionId>{};
}

/// Pixels at least 3 from the border of a region, from left to right.
std::vector<cv::Point> insideOf(const ScanSnapshot& snapshot, RegionId region) {
  cv::Mat mask = (snapshot.regions == static_cast<int>(region.value)) & (snapshot.depth_fused_m > 0);
  cv::copyMakeBorder(mask, mask, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::erode(mask, mask, {}, {-1, -1}, 3);
  std::vector<cv::Point> pixels;
  cv::findNonZero(mask, pixels);
  for (cv::Point& pixel : pixels) pixel -= cv::Point(1, 1);
  std::sort(pixels.begin(), pixels.end(), [](const cv::Point& a, const cv::Point& b) { return a.x < b.x; });
  return pixels;
}

Eigen::Vector3f pointAt(const ScanSnapshot& snapshot, const cv::Point& pixel) {
  return snapshot.pose.T_world_camera.cast<float>() *
         snapshot.K.backProject(static_cast<float>(pixel.x), static_cast<float>(pixel.y),
                                snapshot.depth_fused_m.at<float>(pixel));
}

TEST(RegionEdits, JoinOfTwoObjectsIsUndone_AfterTheScan) {
  const QtMainThread qt;
  const TemporaryFolder folder;
  EditLog log;
  const std::string catalogue = (folder / "catalogue.sqlite").string();
  std::vector<RegionId> pair;
  std::vector<ObjectId> objects;
  {
    ScanWorker worker([&](const ScanEvent& event) { log.add(event); });
    ScanRequest request;
    request.source = "demo";
    request.source_options.frames = 40;
    request.output_folder = folder / "scan";
    request.database = catalogue;
    request.start_paused = true;
    request.skip_refinement = true;
    worker.post(StartScan{request});
    for (int i = 0; i < 36; ++i) worker.post(StepScan{});
    const auto snapshot = snapshotAfter(worker, 36);
    ASSERT_NE(snapshot, nullptr);
    ASSERT_NE(snapshot->region_infos, nullptr);
    for (const RegionInfo& info : *snapshot->region_infos) {
      if (!info.label || !info.label->object || pair.size() == 2) continue;
      pair.push_back(info.region);
      objects.push_back(info.label->object);
    }
    ASSERT_EQ(pair.size(), 2U);
    Operation join;
    join.kind = OperationKind::join;
    join.regions = pair;
    worker.post(EditRegions{join});
    ASSERT_FALSE(log.edit(1).empty());
    worker.post(ResumeScan{});
    worker.wait();
    ASSERT_EQ(worker.state(), ScanState::finished);
  }
  const auto mergeRoot = [&](ObjectId object) {
    return ObjectDatabase::open(catalogue).value()->mergeRoot(object).value();
  };
  EXPECT_EQ(mergeRoot(objects[0]), mergeRoot(objects[1])) << "the scan merged them";
  auto session = OpenSession::open(folder / "scan");
  ASSERT_TRUE(session) << session.error().message();
  ASSERT_TRUE((*session)->undo());
  ASSERT_TRUE(applyToCatalogue(**session));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(mergeRoot(objects[i]), objects[i]);
    EXPECT_EQ((*session)->objectOf(pair[i]), objects[i]);
  }
}

TEST(RegionEdits, AreKeptToTheEnd_AndInTheSavedSession) {
  const QtMainThread qt;
  const TemporaryFolder folder;
  EditLog log;
  std::vector<RegionId> joined;
  RegionId named;
  {
    ScanWorker worker([&](const ScanEvent& event) { log.add(event); });
    ScanRequest request;
    request.source = "demo";
    request.source_options.frames = 40;
    request.output_folder = folder / "scan";
    request.database = (folder / "catalogue.sqlite").string();
    request.start_paused = true;
    worker.post(StartScan{request});
    for (int i = 0; i < 15; ++i) worker.post(StepScan{});
    const std::vector<RegionId> regions = regionsInView(worker, 15);
    ASSERT_GE(regions.size(), 5U);
    joined = {regions[2], regions[3]};
    Operation operation;
    operation.kind = OperationKind::join;
    operation.regions = joined;
    worker.post(EditRegions{operation});
    ASSERT_EQ(log.edit(1), std::vector{joined[0]});
    operation = {};
    operation.regions = {regions[4]};
    operation.name = "mug";
    worker.post(EditRegions{operation});
    ASSERT_EQ(log.edit(2), std::vector{regions[4]});
    operation.name = "cup";
    worker.post(EditRegions{operation});
    ASSERT_FALSE(log.edit(3).empty());
    worker.post(EditRegions{UndoEdit{}});
    ASSERT_FALSE(log.edit(4).empty());
    named = regions[4];
    worker.post(ResumeScan{});
    worker.wait();
    EXPECT_EQ(worker.state(), ScanState::finished);
  }
  EXPECT_TRUE(log.failures().empty());
  auto session = OpenSession::open(folder / "scan");
  ASSERT_TRUE(session) << session.error().message();
  EXPECT_EQ((*session)->frames().size(), 40U);
  EXPECT_EQ((*session)->noteOf(named).name, "mug");
  const auto regions = (*session)->regions();
  ASSERT_TRUE(regions);
  for (const RegionSummary& region : *regions) EXPECT_NE(region.region, joined[1]);
  ASSERT_EQ((*session)->history().entries().size(), 3U);
  // Operations of the scan can be undone in the saved session.
  ASSERT_TRUE((*session)->undo());
  ASSERT_TRUE((*session)->undo());
  EXPECT_FALSE((*session)->undo());
  const auto again = (*session)->regions();
  ASSERT_TRUE(again);
  EXPECT_TRUE(std::ranges::any_of(*again, [&](const auto& region) { return region.region == joined[1]; }));
}

/// A join and a cut in the middle of a scan, and the pixels by which they are checked later.
class JoinAndCutTest : public testing::Test {
 protected:
  static constexpr int kEditedAfter = 20;

  ScanRequest request(int start, int frames) const {
    ScanRequest request;
    request.source = "demo";
    request.source_options.start = start;
    request.source_options.frames = frames;
    request.output_folder = folder_ / "scan";
    request.database = (folder_ / "catalogue.sqlite").string();
    return request;
  }

  /// Cuts the largest region between two distant pixels, here_ and there_.
  void cutLargest(ScanWorker& worker, const ScanSnapshot& snapshot) {
    const RegionId region = regionsIn(snapshot).at(0);
    const std::vector<cv::Point> inside = insideOf(snapshot, region);
    ASSERT_GT(inside.size(), 100U);
    here_ = inside[inside.size() / 20];
    there_ = inside[inside.size() - inside.size() / 20];
    Operation cut;
    cut.kind = OperationKind::cut;
    cut.regions = {region};
    cut.here_world = {pointAt(snapshot, here_)};
    cut.there_world = {pointAt(snapshot, there_)};
    worker.post(EditRegions{cut});
    ASSERT_EQ(log_.edit(1).size(), 2U);
  }

  void scanAndEdit(int frames) {
    ScanWorker worker([&](const ScanEvent& event) { log_.add(event); });
    ScanRequest requested = request(0, frames);
    requested.start_paused = true;
    worker.post(StartScan{requested});
    for (int i = 0; i < kEditedAfter; ++i) worker.post(StepScan{});
    const auto snapshot = snapshotAfter(worker, kEditedAfter);
    ASSERT_NE(snapshot, nullptr);
    const std::vector<RegionId> regions = regionsIn(*snapshot);
    ASSERT_GE(regions.size(), 4U);
    const std::vector<cv::Point> first = insideOf(*snapshot, regions[1]),
                                 second = insideOf(*snapshot, regions[2]);
    ASSERT_FALSE(first.empty() || second.empty());
    one_ = first[first.size() / 2];
    other_ = second[second.size() / 2];
    ASSERT_NO_FATAL_FAILURE(cutLargest(worker, *snapshot));
    Operation join;
    join.kind = OperationKind::join;
    join.regions = {regions[1], regions[2]};
    worker.post(EditRegions{join});
    ASSERT_FALSE(log_.edit(2).empty());
    worker.post(ResumeScan{});
    worker.wait();
    ASSERT_EQ(worker.state(), ScanState::finished);
  }

  /// Checks the regions at the pixels, in the frame of the edits.
  void expectApplied() {
    auto session = OpenSession::open(folder_ / "scan");
    ASSERT_TRUE(session) << session.error().message();
    const auto at = [&](const cv::Point& pixel) {
      // A working pixel is two pixels of the recording wide.
      const auto found = (*session)->at(kEditedAfter - 1, 2 * pixel.x, 2 * pixel.y);
      EXPECT_TRUE(found) << found.error().message();
      return found ? found->region : RegionId{};
    };
    EXPECT_TRUE(at(here_) && at(there_));
    EXPECT_NE(at(here_), at(there_)) << "the cut region is two";
    EXPECT_TRUE(at(one_));
    EXPECT_EQ(at(one_), at(other_)) << "the joined regions are one";
  }

  QtMainThread qt_;
  TemporaryFolder folder_;
  EditLog log_;
  cv::Point here_, there_, one_, other_;
};

TEST_F(JoinAndCutTest, AreKeptToTheEnd_AndWhenTheScanResumes) {
  ASSERT_NO_FATAL_FAILURE(scanAndEdit(40));
  expectApplied();
  ScanWorker worker([&](const ScanEvent& event) { log_.add(event); });
  ScanRequest more = request(40, 15);
  more.resume = true;
  worker.post(StartScan{more});
  worker.wait();
  ASSERT_EQ(worker.state(), ScanState::finished);
  worker.post(StartScan{[&] {  // closes the saved scan
    ScanRequest nothing = request(0, 1);
    nothing.output_folder.reset();
    return nothing;
  }()});
  worker.wait();
  expectApplied();
  EXPECT_TRUE(log_.failures().empty());
}

TEST_F(JoinAndCutTest, CutIsUndone_AfterMoreFrames) {
  ScanWorker worker([&](const ScanEvent& event) { log_.add(event); });
  ScanRequest requested = request(0, 40);
  requested.start_paused = true;
  requested.skip_refinement = true;
  worker.post(StartScan{requested});
  for (int i = 0; i < kEditedAfter; ++i) worker.post(StepScan{});
  const auto snapshot = snapshotAfter(worker, kEditedAfter);
  ASSERT_NE(snapshot, nullptr);
  ASSERT_NO_FATAL_FAILURE(cutLargest(worker, *snapshot));
  for (int i = 0; i < 12; ++i) worker.post(StepScan{});
  ASSERT_NE(snapshotAfter(worker, kEditedAfter + 12), nullptr);
  worker.post(EditRegions{UndoEdit{}});
  ASSERT_FALSE(log_.edit(2).empty());
  worker.post(ResumeScan{});
  worker.wait();
  worker.post(CloseScan{});
  auto saved = OpenSession::open(folder_ / "scan");
  ASSERT_TRUE(saved) << saved.error().message();
  const auto here = (*saved)->at(kEditedAfter - 1, 2 * here_.x, 2 * here_.y);
  const auto there = (*saved)->at(kEditedAfter - 1, 2 * there_.x, 2 * there_.y);
  ASSERT_TRUE(here && there);
  EXPECT_EQ(here->region, there->region);
}

TEST(RegionEdits, ImpossibleEditIsReported_AndTheScanContinues) {
  const QtMainThread qt;
  const TemporaryFolder folder;
  EditLog log;
  ScanWorker worker([&](const ScanEvent& event) { log.add(event); });
  ScanRequest request;
  request.source = "demo";
  request.source_options.frames = 5;
  request.database = (folder / "catalogue.sqlite").string();
  request.start_paused = true;
  worker.post(StartScan{request});
  worker.post(StepScan{});
  Operation operation;
  operation.regions = {RegionId{777}};
  operation.name = "x";
  worker.post(EditRegions{operation});
  EXPECT_TRUE(log.edit(1).empty());
  worker.post(ResumeScan{});
  worker.wait();
  EXPECT_EQ(worker.state(), ScanState::finished);
  ASSERT_EQ(log.failures().size(), 1U);
  EXPECT_NE(log.failures()[0].find("777"), std::string::npos);
}

}  // namespace
}  // namespace scantrove::test
