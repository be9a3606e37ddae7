#include "core/scan/snapshot_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <set>
#include <thread>
#include <tuple>

#include "core/synthetic/scene_recipe.h"
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

/// A builder with a small pipeline that scans the synthetic table top with true poses.
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
    makePipeline(options.K, {});
  }

  void makePipeline(const Intrinsics& K, const MappingParams& params) {
    auto pipeline = MappingPipeline::create(*compute_, {K, params, PoseUse::given});
    ASSERT_TRUE(pipeline) << pipeline.error().message();
    pipeline_ = std::move(*pipeline);
  }

  /// Processes the next frame, with or without its pose. Result: the bricks that it touched.
  Bricks addFrame(bool with_pose = true) {
    FrameRead read = source_->next();
    if (!with_pose) read.frame.T_world_camera.reset();
    Result<FrameResult> result = pipeline_->processFrame(read.frame);
    EXPECT_TRUE(result) << result.error().message();
    ++progress_.frames.read;
    builder_.addFrame(*pipeline_, std::move(read.frame), std::move(*result));
    Bricks bricks;
    for (const Eigen::Vector3i& brick : pipeline_->touchedBricks()) {
      bricks.emplace(brick.x(), brick.y(), brick.z());
    }
    return bricks;
  }

  /// The next snapshot after the minimum interval; null: none comes.
  std::shared_ptr<const ScanSnapshot> nextWhenDue() {
    std::this_thread::sleep_for(std::chrono::milliseconds(120));
    EXPECT_TRUE(builder_.postWhenDue(*pipeline_, progress_));
    return mailbox_.collect();
  }

  std::unique_ptr<SyntheticSource> source_;
  std::unique_ptr<ComputeContext> compute_;
  std::unique_ptr<MappingPipeline> pipeline_;
  LatestValue<ScanSnapshot> mailbox_;
  SnapshotBuilder builder_{mailbox_};
  ScanProgress progress_{ScanState::scanning, {}, 10};
};

TEST_F(SnapshotBuilderTest, SendsAllBricks_ALimitedNumberPerSnapshot) {
  const Bricks changed = addFrame();
  ASSERT_GT(changed.size(), SnapshotBuilder::kMaxBricks);
  Bricks sent;
  while (sent.size() < changed.size()) {
    const auto snapshot = nextWhenDue();
    ASSERT_TRUE(snapshot);
    ASSERT_FALSE(snapshot->changed_bricks.empty());
    ASSERT_LE(snapshot->changed_bricks.size(), SnapshotBuilder::kMaxBricks);
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

TEST_F(SnapshotBuilderTest, ShowsTheLastColor_WhenAFrameHasNone) {
  addFrame();
  FrameRead read = source_->next();
  const cv::Mat color = read.frame.color;
  const auto add = [&](RgbdFrame frame) {
    Result<FrameResult> result = pipeline_->processFrame(frame);
    ASSERT_TRUE(result) << result.error().message();
    builder_.addFrame(*pipeline_, std::move(frame), std::move(*result));
  };
  add(read.frame);
  RgbdFrame depth_only = source_->next().frame;
  depth_only.color.release();
  depth_only.intrinsics = Intrinsics{133, 133, 79.5F, 59.5F, 160, 120};
  add(depth_only);
  ASSERT_TRUE(builder_.flush(*pipeline_, progress_));
  const auto snapshot = mailbox_.collect();
  ASSERT_TRUE(snapshot);
  EXPECT_EQ(snapshot->frame_index, depth_only.index);
  EXPECT_EQ(snapshot->color.data, color.data);
  EXPECT_EQ(snapshot->K, *depth_only.intrinsics) << "the camera of this frame";
}

TEST_F(SnapshotBuilderTest, HasNumbersOnly_WithoutPictures) {
  builder_.omitPictures();
  ASSERT_FALSE(addFrame().empty());
  ASSERT_TRUE(builder_.flush(*pipeline_, progress_));
  const auto snapshot = mailbox_.collect();
  ASSERT_TRUE(snapshot);
  EXPECT_TRUE(snapshot->changed_bricks.empty());
  EXPECT_TRUE(snapshot->color.empty());
  EXPECT_TRUE(snapshot->regions.empty());
  EXPECT_FALSE(snapshot->changed_regions.empty());
  EXPECT_EQ(snapshot->frames.done(), 1);
  EXPECT_TRUE(snapshot->pose.usable());
  EXPECT_GT(snapshot->region_count, 0);
  EXPECT_FALSE(snapshot->stage_times.empty());
}

TEST_F(SnapshotBuilderTest, CountsTheRegionsInView) {
  static_cast<void>(addFrame());
  ASSERT_TRUE(builder_.flush(*pipeline_, progress_));
  const auto snapshot = mailbox_.collect();
  std::set<std::int32_t> in_view(snapshot->regions.begin<std::int32_t>(),
                                 snapshot->regions.end<std::int32_t>());
  in_view.erase(0);
  ASSERT_GT(in_view.size(), 1U);
  EXPECT_EQ(snapshot->region_count, static_cast<int>(in_view.size()));
}

TEST_F(SnapshotBuilderTest, ProposesSupportsAsBackground) {
  static_cast<void>(addFrame());
  const auto infosNow = [this] {
    EXPECT_TRUE(builder_.flush(*pipeline_, progress_));
    return *mailbox_.collect()->region_infos;
  };
  const RegionInfos before = infosNow();
  ASSERT_GT(before.size(), 1U);
  const RegionId support = before.front().region, other = before.back().region;
  RegionTable& table = pipeline_->labels().table();
  constexpr float kMuch = 1e7F;  // more than the frame has pixels
  table.addSupportPixels(table.fragmentsOf(support).front(), {kMuch, kMuch, 0});
  table.addSupportPixels(table.fragmentsOf(other).front(), {kMuch, 0, kMuch});
  EXPECT_TRUE(infosNow().front().is_proposed_background);
  EXPECT_FALSE(infosNow().back().is_proposed_background);
  Operation mark;
  mark.kind = OperationKind::background;
  mark.regions = {support};
  ASSERT_TRUE(pipeline_->edit(mark));
  EXPECT_FALSE(infosNow().front().is_proposed_background);
}

// Changes by a user come with the next snapshot, marked, however many bricks wait.
TEST_F(SnapshotBuilderTest, SendsChangesByAUserFirst) {
  static_cast<void>(addFrame());
  ASSERT_TRUE(builder_.flush(*pipeline_, progress_));
  const auto all = mailbox_.collect();
  // Cuts the largest region between its leftmost and rightmost points.
  std::map<RegionId, std::vector<Eigen::Vector3f>> points;
  for (const CloudBrick& brick : all->changed_bricks) {
    EXPECT_FALSE(brick.by_person);
    for (const CloudBrick::Point& point : brick.points)
      points[pipeline_->labels().table().regionOf(point.fragment)].push_back(point.center());
  }
  const auto largest =
      std::ranges::max_element(points, {}, [](const auto& entry) { return entry.second.size(); });
  const auto [left, right] = std::ranges::minmax_element(
      largest->second, {}, [](const Eigen::Vector3f& point) { return point.x(); });
  const Bricks changed = addFrame();
  ASSERT_GT(changed.size(), SnapshotBuilder::kMaxBricks) << "all of them wait";
  Operation cut{.kind = OperationKind::cut, .regions = {largest->first}};
  cut.here_world = {*left};
  cut.there_world = {*right};
  builder_.beginEdit(*pipeline_);
  const auto outcome = pipeline_->edit(cut);
  builder_.endEdit(*pipeline_);
  ASSERT_TRUE(outcome) << outcome.error().message();

  const auto shown = nextWhenDue();
  ASSERT_TRUE(shown);
  const auto isByPerson = [](const auto& change) { return change.by_person; };
  const auto edited = std::ranges::count_if(shown->changed_bricks, isByPerson);
  EXPECT_GT(edited, 0);
  for (std::ptrdiff_t i = 0; i < edited; ++i)
    EXPECT_TRUE(shown->changed_bricks[static_cast<std::size_t>(i)].by_person) << i;
  EXPECT_GT(std::ranges::count_if(shown->changed_regions, isByPerson), 0);
  // No brick is lost or sent twice.
  Bricks sent = bricksOf(*shown);
  std::size_t count = shown->changed_bricks.size();
  for (auto next = nextWhenDue(); !next->changed_bricks.empty(); next = nextWhenDue()) {
    EXPECT_EQ(std::ranges::count_if(next->changed_bricks, isByPerson), 0);
    sent.merge(bricksOf(*next));
    count += next->changed_bricks.size();
  }
  EXPECT_EQ(sent.size(), count);
  EXPECT_TRUE(std::ranges::includes(sent, changed));
  // An undo changes regions only.
  builder_.beginEdit(*pipeline_);
  ASSERT_TRUE(pipeline_->undo());
  builder_.endEdit(*pipeline_);
  const auto undone = nextWhenDue();
  ASSERT_TRUE(undone);
  ASSERT_FALSE(undone->changed_regions.empty());
  EXPECT_TRUE(std::ranges::all_of(undone->changed_regions, isByPerson));
}

TEST_F(SnapshotBuilderTest, HasTheLastTrackedImage_WhileTrackingIsLost) {
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
  EXPECT_TRUE(mailbox_.collect()->last_seen.empty()) << "the scan has ended";
}

TEST_F(SnapshotBuilderTest, PostsNoSnapshot_BeforeTheLastIsCollected) {
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

TEST_F(SnapshotBuilderTest, FlushSendsUncollectedAndWaitingBricks) {
  Bricks changed = addFrame();
  ASSERT_TRUE(builder_.postWhenDue(*pipeline_, progress_));  // skipped by the window
  changed.merge(addFrame());
  ASSERT_GT(changed.size(), 2 * SnapshotBuilder::kMaxBricks);
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

TEST_F(SnapshotBuilderTest, SendsChangedRegionsOnly) {
  static_cast<void>(addFrame());
  ASSERT_TRUE(builder_.flush(*pipeline_, progress_));
  const auto first = mailbox_.collect();
  ASSERT_FALSE(first->changed_regions.empty());
  ASSERT_TRUE(builder_.flush(*pipeline_, progress_));
  EXPECT_TRUE(mailbox_.collect()->changed_regions.empty());
}

TEST_F(SnapshotBuilderTest, NewerBricksHaveGreaterVersions) {
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

/// Points by brick.
using Shown =
    std::map<std::tuple<int, int, int>, std::vector<std::tuple<float, float, float, std::uint32_t>>>;

void show(const ScanSnapshot& snapshot, Shown& shown) {
  for (const CloudBrick& brick : snapshot.changed_bricks) {
    auto& points = shown[{brick.position.x(), brick.position.y(), brick.position.z()}];
    points.clear();
    for (const auto& p : brick.points) points.emplace_back(p.x, p.y, p.z, p.fragment.value);
  }
}

// Bricks that moved to disk before they were sent are still sent; sent bricks keep their shown points when
// others reuse their slots.
TEST_F(SnapshotBuilderTest, SendsTheSame_WhenMostOfTheMapIsOnDisk) {
  SyntheticOptions options;
  options.recipe = synthetic::makeCorridorScene;
  options.K = Intrinsics{131, 131, 79.5F, 59.5F, 160, 120};
  options.noise = false;
  options.color = false;
  options.stride = 60;  // 1.5 m
  options.at_most = 14;
  std::array<Shown, 2> shown;
  for (const int budget_mb : {0, 6}) {
    MappingParams params;
    params.fusion.voxel_size_m = 0.02F;
    params.fusion.max_depth_m = 3;
    params.fusion.memory_budget_mb = budget_mb;
    makePipeline(options.K, params);
    source_ = std::move(*makeSyntheticSource(options));
    SnapshotBuilder builder(mailbox_);
    std::uint64_t stored = 0;
    Shown& shown_in_run = shown[budget_mb == 0 ? 0 : 1];
    for (FrameRead read = source_->next(); read.status == FrameRead::Status::frame; read = source_->next()) {
      Result<FrameResult> result = pipeline_->processFrame(read.frame);
      ASSERT_TRUE(result) << result.error().message();
      const int index = read.frame.index;
      builder.addFrame(*pipeline_, std::move(read.frame), std::move(*result));
      stored = std::max(stored, pipeline_->bricks().storedBytes());
      if (index / options.stride % 5 != 4) continue;
      ASSERT_TRUE(builder.flush(*pipeline_, progress_));
      show(*mailbox_.collect(), shown_in_run);
    }
    ASSERT_TRUE(builder.flush(*pipeline_, progress_));
    show(*mailbox_.collect(), shown_in_run);
    EXPECT_EQ(stored > 0, budget_mb > 0);
    EXPECT_FALSE(pipeline_->bricks().takeFailure());
  }
  EXPECT_GT(shown[0].size(), 3000U);
  EXPECT_EQ(shown[1], shown[0]);
}

}  // namespace
}  // namespace scantrove
