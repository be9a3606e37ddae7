#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <tuple>
#include <vector>

#include "core/synthetic/scene_recipe.h"
#include "tests/support/synthetic_scan.h"
#include "tests/support/temporary_folder.h"

namespace scantrove {
namespace {

using test::SyntheticScan;
using testing::HasSubstr;

/// A coarse scan of the corridor whose map is about ten times the budget of 9 MiB.
SyntheticOptions corridorOptions() {
  SyntheticOptions options;
  options.recipe = synthetic::makeCorridorScene;
  options.K = Intrinsics{131, 131, 79.5F, 59.5F, 160, 120};
  options.noise = false;
  options.stride = 20;  // 0.5 m
  options.at_most = 40;
  return options;
}

MappingParams paramsWith(int budget_mb) {
  MappingParams params;
  params.fusion.voxel_size_m = 0.02F;
  params.fusion.max_depth_m = 3;
  params.fusion.memory_budget_mb = budget_mb;
  return params;
}

using Point = std::tuple<float, float, float, std::uint32_t>;

std::vector<Point> cloudOf(MappingPipeline& pipeline) {
  std::vector<Point> cloud;
  const Result<void> read = pipeline.readout().forEachCloudPoint([&](const LabelPoint& point) {
    const RegionId region = pipeline.labels().table().regionOf(FragmentId{point.fragment});
    cloud.emplace_back(point.x, point.y, point.z, region.value);
  });
  EXPECT_TRUE(read) << (read ? "" : read.error().message());
  return cloud;
}

/// Sets TMPDIR while it lives.
class TemporaryFilesIn {
 public:
  explicit TemporaryFilesIn(const std::string& folder) {
    if (const char* before = std::getenv("TMPDIR")) before_ = before;
    setenv("TMPDIR", folder.c_str(), 1);
  }
  TemporaryFilesIn(const TemporaryFilesIn&) = delete;
  TemporaryFilesIn& operator=(const TemporaryFilesIn&) = delete;
  ~TemporaryFilesIn() {
    if (before_.empty()) {
      unsetenv("TMPDIR");
    } else {
      setenv("TMPDIR", before_.c_str(), 1);
    }
  }

 private:
  std::string before_;
};

class MemoryBudgetTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    unlimited_ = std::make_unique<SyntheticScan>(corridorOptions(), paramsWith(0), PoseUse::given);
    unlimited_->run();
    cloud_ = cloudOf(unlimited_->pipeline());
  }
  static void TearDownTestSuite() { unlimited_.reset(); }

  static std::unique_ptr<SyntheticScan> unlimited_;
  static std::vector<Point> cloud_;
};

std::unique_ptr<SyntheticScan> MemoryBudgetTest::unlimited_;
std::vector<Point> MemoryBudgetTest::cloud_;

TEST_F(MemoryBudgetTest, DoesNotChangePointsLabelsMeshOrViews) {
  ASSERT_EQ(unlimited_->pipeline().bricks().storedBytes(), 0U);
  SyntheticScan scan(corridorOptions(), paramsWith(9), PoseUse::given);
  scan.run();
  EXPECT_FALSE(scan.pipeline().bricks().takeFailure());
  const BrickMap& bricks = scan.pipeline().bricks();
  EXPECT_EQ(bricks.brickCount(), unlimited_->pipeline().bricks().brickCount());
  EXPECT_LT(3 * bricks.device().brickCount(), bricks.brickCount()) << "most of the map was on the device";
  EXPECT_LE(bricks.device().bytes(), std::size_t{9} << 20U);
  EXPECT_EQ(scan.pipeline().labels().voxelsOfFragments(),
            unlimited_->pipeline().labels().voxelsOfFragments());
  EXPECT_GT(cloud_.size(), 100000U);
  EXPECT_TRUE(cloudOf(scan.pipeline()) == cloud_);
  const auto mesh = scan.pipeline().readout().extractMesh();
  const auto mesh_unlimited = unlimited_->pipeline().readout().extractMesh();
  ASSERT_TRUE(mesh && *mesh && mesh_unlimited && *mesh_unlimited);
  EXPECT_GT((*mesh)->faces.size(), 100000U);
  EXPECT_GT(2 * std::ranges::count((*mesh)->vertices, true, &SurfaceMesh::Vertex::has_color),
            std::ssize((*mesh)->vertices));
  EXPECT_TRUE(**mesh == **mesh_unlimited);
  // Renders bricks that moved to disk long ago.
  for (const std::size_t i : {std::size_t{0}, scan.frames.size() / 2}) {
    const cv::Mat view = scan.finalRegions(scan.frames[i]);
    EXPECT_GT(cv::countNonZero(view), view.rows * view.cols / 2);
    EXPECT_EQ(cv::norm(view, unlimited_->finalRegions(unlimited_->frames[i]), cv::NORM_INF), 0);
  }
  EXPECT_TRUE(cloudOf(scan.pipeline()) == cloud_) << "after the views moved bricks";
}

TEST_F(MemoryBudgetTest, ScanContinuesAndReportsIt_WithoutADisk) {
  const test::TemporaryFolder folder;
  const TemporaryFilesIn nowhere((folder.path() / "nowhere").string());
  SyntheticScan scan(corridorOptions(), paramsWith(9), PoseUse::given);
  scan.run();
  const auto failure = scan.pipeline().bricks().takeFailure();
  ASSERT_TRUE(failure);
  EXPECT_THAT(failure->message(), HasSubstr("nowhere"));
  EXPECT_FALSE(scan.pipeline().bricks().takeFailure());
  EXPECT_EQ(scan.pipeline().bricks().storedBytes(), 0U);
  EXPECT_TRUE(cloudOf(scan.pipeline()) == cloud_);
}

}  // namespace
}  // namespace scantrove
