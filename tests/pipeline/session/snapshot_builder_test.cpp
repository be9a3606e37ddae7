#include "core/scan/snapshot_builder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <thread>
#include <tuple>

#include "core/synthetic/synthetic_source.h"

namespace scantrove {
namespace {

using Bricks = std::set<std::tuple<int, int, int>>;

Bricks bricksOf(const ScanSnapshot& snapshot) {
  Bricks bricks;
  for (const CloudBrick& brick : snapshot.changed_bricks) {
    bricks.emplace(brick.position.x(), brick.position.y(), brick.position.z());
  }
  return bricks;
}

/// The builder behind a small pipeline that films the table top with its true poses.
class SnapshotBuilderTest : public testing::Test {
 protected:
  void SetUp() override {
    SyntheticOptions options;
    options.K = Intrinsics{131, 131, 79.5F, 59.5F, 160, 120};
    options.noise = false;
    auto source = makeSyntheticSource(options);
    ASSERT_TRUE(source) << source.error().message();
    source_ = std::move(*source);
    auto compute = ComputeContext::create({});
    ASSERT_TRUE(compute) << compute.error().message();
    compute_ = std::move(*compute);
    auto pipeline = ScanPipeline::create(*compute_, {options.K, {}, true, nullptr, 0});
    ASSERT_TRUE(pipeline) << pipeline.error().message();
    pipeline_ = std::move(*pipeline);
  }

  /// Processes a frame, with its pose or without; its bricks.
  Bricks addFrame(bool with_pose = true) {
    FrameRead read = source_->next();
    if (!with_pose) read.frame.T_world_camera.reset();
    Result<FrameResult> result = pipeline_->processFrame(read.frame);
    EXPECT_TRUE(result) << result.error().message();
    ++progress_.frames.read;
    builder_.addFrame(*pipeline_, std::move(read.frame), std::move(*result));
    Bricks bricks;
    for (const cl_int slot : pipeline_->touchedSlots()) {
      const Eigen::Vector3i& position = pipeline_->bricks().positionOf(slot);
      bricks.emplace(position.x(), position.y(), position.z());
    }
    return bricks;
  }

  /// The snapshot that comes once the pause between two is over; null when none comes.
  std::shared_ptr<const ScanSnapshot> nextWhenDue() {
    std::this_thread::sleep_for(std::chrono::milliseconds(120));
    EXPECT_TRUE(builder_.postWhenDue(*pipeline_, progress_));
    return mailbox_.collect();
  }

  std::unique_ptr<SyntheticSource> source_;
  std::unique_ptr<ComputeContext> compute_;
  std::unique_ptr<ScanPipeline> pipeline_;
  LatestValue<ScanSnapshot> mailbox_;
  SnapshotBuilder builder_{mailbox_};
  ScanProgress progress_{ScanState::scanning, {}, 10};
};

TEST_F(SnapshotBuilderTest, SendsABoundedNumberOfBricksUntilAllWereSent) {
  const Bricks changed = addFrame();
  ASSERT_GT(changed.size(), SnapshotBuilder::kMostBricks);
  Bricks sent;
  while (sent.size() < changed.size()) {
    const auto snapshot = nextWhenDue();
    ASSERT_TRUE(snapshot);
    ASSERT_FALSE(snapshot->changed_bricks.empty());
    ASSERT_LE(snapshot->changed_bricks.size(), SnapshotBuilder::kMostBricks);
    sent.merge(bricksOf(*snapshot));
  }
  EXPECT_EQ(sent, changed);
  const auto idle = nextWhenDue();
  ASSERT_TRUE(idle);
  EXPECT_TRUE(idle->changed_bricks.empty());
  EXPECT_EQ(idle->frames.done(), 1);
  EXPECT_EQ(idle->frames_total, 10);
  EXPECT_EQ(idle->trail->size(), 1U);
}

TEST_F(SnapshotBuilderTest, WhileTheCameraIsLostShowsWhatItSawLast) {
  addFrame();
  const auto tracked = nextWhenDue();
  ASSERT_TRUE(tracked);
  EXPECT_TRUE(tracked->last_seen.empty());
  addFrame(false);
  const auto lost = nextWhenDue();
  ASSERT_TRUE(lost);
  EXPECT_FALSE(lost->pose.usable());
  ASSERT_FALSE(lost->last_seen.empty());
  EXPECT_EQ(cv::norm(lost->last_seen, tracked->color, cv::NORM_INF), 0);
  progress_.state = ScanState::finished;
  ASSERT_TRUE(builder_.flush(*pipeline_, progress_));
  EXPECT_TRUE(mailbox_.collect()->last_seen.empty()) << "nobody looks for it any more";
}

TEST_F(SnapshotBuilderTest, MakesNoneBeforeTheLastWasCollected) {
  static_cast<void>(addFrame());
  ASSERT_TRUE(builder_.postWhenDue(*pipeline_, progress_));
  static_cast<void>(addFrame());
  std::this_thread::sleep_for(std::chrono::milliseconds(120));
  ASSERT_TRUE(builder_.postWhenDue(*pipeline_, progress_));
  const auto snapshot = mailbox_.collect();
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(snapshot->frames.done(), 1);
  EXPECT_FALSE(mailbox_.collect());
}

TEST_F(SnapshotBuilderTest, AFlushCarriesWhatWasNotCollectedAndAllThatWaits) {
  Bricks changed = addFrame();
  ASSERT_TRUE(builder_.postWhenDue(*pipeline_, progress_));  // skipped by the window
  changed.merge(addFrame());
  ASSERT_GT(changed.size(), 2 * SnapshotBuilder::kMostBricks);
  ASSERT_TRUE(builder_.flush(*pipeline_, progress_));
  const auto snapshot = mailbox_.collect();
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(bricksOf(*snapshot), changed);
  EXPECT_EQ(snapshot->frames.done(), 2);
  std::set<FragmentId> with_region;
  for (const RegionChange& change : snapshot->changed_regions) with_region.insert(change.fragment);
  for (const CloudBrick& brick : snapshot->changed_bricks) {
    for (const CloudBrick::Point& point : brick.points) ASSERT_TRUE(with_region.contains(point.fragment));
  }
}

// Fragments that did not change region are not sent again.
TEST_F(SnapshotBuilderTest, OnlyChangedRegionsAreSent) {
  static_cast<void>(addFrame());
  ASSERT_TRUE(builder_.flush(*pipeline_, progress_));
  const auto first = mailbox_.collect();
  ASSERT_FALSE(first->changed_regions.empty());
  ASSERT_TRUE(builder_.flush(*pipeline_, progress_));
  EXPECT_TRUE(mailbox_.collect()->changed_regions.empty());
}

// Newer points of a brick have a greater version than those that went before them.
TEST_F(SnapshotBuilderTest, VersionsGrow) {
  static_cast<void>(addFrame());
  ASSERT_TRUE(builder_.flush(*pipeline_, progress_));
  const auto first = mailbox_.collect();
  static_cast<void>(addFrame());
  ASSERT_TRUE(builder_.flush(*pipeline_, progress_));
  const auto second = mailbox_.collect();
  ASSERT_TRUE(first && second);
  ASSERT_FALSE(first->changed_bricks.empty() || second->changed_bricks.empty());
  EXPECT_GT(second->changed_bricks.front().version, first->changed_bricks.back().version);
}

}  // namespace
}  // namespace scantrove
