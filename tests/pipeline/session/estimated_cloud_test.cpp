// Estimated surface in the cloud of a scan, and in what the window shows.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/scan/scan_output.h"
#include "core/scan/snapshot_builder.h"
#include "tests/support/table_with_glass.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/dataset/ply_reader.h"

namespace scantrove {
namespace {

using test::kGlassOnTable;
using test::kOverTable;

class EstimatedCloudTest : public testing::Test {
 protected:
  void SetUp() override {
    auto compute = ComputeContext::create({});
    ASSERT_TRUE(compute) << compute.error().message();
    compute_ = std::move(*compute);
    auto pipeline = MappingPipeline::create(*compute_, {kOverTable, {}});
    ASSERT_TRUE(pipeline) << pipeline.error().message();
    pipeline_ = std::move(*pipeline);
    auto result = pipeline_->processFrame(test::tableFrame());
    ASSERT_TRUE(result) << result.error().message();
    result_ = std::move(*result);
    const Intrinsics& K = result_.view.K;
    const cv::Point middle = (kGlassOnTable.tl() + kGlassOnTable.br()) / 2;
    const std::size_t pixel =
        K.indexOf(middle.x * K.width / kOverTable.width, middle.y * K.height / kOverTable.height);
    glass_ = result_.view.regions[pixel];
    glass_fragment_ = result_.view.fragments[pixel];
    ASSERT_TRUE(glass_);
  }

  /// Whether the first camera sees the point in the glass or within 20 pixels of it, about as far as the
  /// table.
  static bool isInGlass(double x, double y, double z) {
    const int margin_px = 20;
    const cv::Rect around =
        kGlassOnTable + cv::Size(2 * margin_px, 2 * margin_px) - cv::Point(margin_px, margin_px);
    const cv::Point pixel(static_cast<int>(kOverTable.fx * x / z + kOverTable.cx),
                          static_cast<int>(kOverTable.fy * y / z + kOverTable.cy));
    return z > 0.8 && z < 1.05 && around.contains(pixel);
  }

  std::unique_ptr<ComputeContext> compute_;
  std::unique_ptr<MappingPipeline> pipeline_;
  FrameResult result_;
  RegionId glass_;
  FragmentId glass_fragment_;
};

TEST_F(EstimatedCloudTest, CloudOfAScanMarksItsPoints) {
  const test::TemporaryFolder folder;
  const auto output = ScanOutput::create(folder / "scan", false);
  ASSERT_TRUE(output) << output.error().message();
  const auto done =
      (*output)->finish(*pipeline_, {}, ScanReport{}, [](const FinalLabelRecord&) { return Result<void>(); });
  ASSERT_TRUE(done) << done.error().message();
  const test::PlyFile cloud(test::readText(folder / "scan/cloud.ply"));
  const auto at = [&](const char* name, std::size_t i) { return cloud.values.at(name)[i]; };
  std::size_t measured = 0, of_glass = 0;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const bool is_glass = at("label", i) == glass_.value;
    if (at("estimated", i) == 0) {
      ++measured;
    } else if (is_glass) {
      ++of_glass;
      EXPECT_TRUE(isInGlass(at("x", i), at("y", i), at("z", i))) << i;
    }
    EXPECT_TRUE(at("estimated", i) == 0 || at("label", i) > 0) << "estimated surface has a region";
  }
  EXPECT_EQ((*output)->cloudPoints(), measured);
  EXPECT_GT(of_glass, 20U);
  const auto labels = nlohmann::json::parse(test::readText(folder / "scan/labels.json"));
  EXPECT_TRUE(labels.contains(std::to_string(glass_.value)));
}

TEST_F(EstimatedCloudTest, WindowGetsItsPointsWithoutNormals_OnceUntilTheyChange) {
  LatestValue<ScanSnapshot> mailbox;
  SnapshotBuilder builder(mailbox);
  builder.addFrame(*pipeline_, test::tableFrame(), result_);
  ASSERT_TRUE(builder.flush(*pipeline_, {}));
  const auto snapshot = mailbox.collect();
  ASSERT_TRUE(snapshot);
  std::size_t shown = 0;
  for (const CloudBrick& brick : snapshot->changed_bricks) {
    for (const CloudBrick::Point& point : brick.points) {
      if (point.fragment != glass_fragment_ || point.normal.known()) continue;
      ++shown;
      EXPECT_TRUE(isInGlass(double{point.x}, double{point.y}, double{point.z}));
    }
  }
  EXPECT_GT(shown, 20U);
  ASSERT_TRUE(builder.flush(*pipeline_, {}));
  EXPECT_TRUE(mailbox.collect()->changed_bricks.empty());
}

}  // namespace
}  // namespace scantrove
