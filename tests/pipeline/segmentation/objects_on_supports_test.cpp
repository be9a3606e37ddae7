#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <set>

#include "core/pipeline/mapping_pipeline.h"
#include "tests/support/table_with_glass.h"

namespace scantrove {
namespace {

using test::kBoxOnTable;
using test::kGlassOnTable;
using test::kOverTable;
using test::kSheetOnTable;
using test::tableFrame;

class ObjectsOnSupportsTest : public testing::Test {
 protected:
  void SetUp() override {
    auto compute = ComputeContext::create({});
    ASSERT_TRUE(compute) << compute.error().message();
    compute_ = std::move(*compute);
  }

  /// The first frame of a scan.
  FrameResult process(LabelingParams::Rule rule) {
    MappingParams params;
    params.labeling.rule = rule;
    auto pipeline = MappingPipeline::create(*compute_, {kOverTable, params});
    EXPECT_TRUE(pipeline) << pipeline.error().message();
    pipeline_ = std::move(*pipeline);
    auto result = pipeline_->processFrame(tableFrame());
    EXPECT_TRUE(result) << result.error().message();
    return std::move(*result);
  }

  /// The region in the middle of a rectangle of the frame.
  static RegionId regionIn(const FrameResult& result, const cv::Rect& place) {
    const Intrinsics& K = result.view.K;
    const int u = (place.x + place.width / 2) * K.width / kOverTable.width;
    const int v = (place.y + place.height / 2) * K.height / kOverTable.height;
    return result.view.regions[K.indexOf(u, v)];
  }

  std::unique_ptr<ComputeContext> compute_;
  std::unique_ptr<MappingPipeline> pipeline_;
};

TEST_F(ObjectsOnSupportsTest, BoxSheetAndHoleInDepthAreRegionsOfTheirOwn) {
  const FrameResult result = process(LabelingParams::Rule::graph);
  const RegionId table = regionIn(result, {20, 400, 60, 60});
  std::set<RegionId> regions{table};
  for (const cv::Rect& place : {kBoxOnTable, kSheetOnTable, kGlassOnTable})
    regions.insert(regionIn(result, place));
  EXPECT_TRUE(table);
  EXPECT_EQ(regions.size(), 4U);
  EXPECT_FALSE(regions.contains(RegionId{}));
}

TEST_F(ObjectsOnSupportsTest, PreviewOfParametersEqualsTheFrame) {
  const FrameResult result = process(LabelingParams::Rule::graph);
  const auto again = pipeline_->segmentAgain();
  ASSERT_TRUE(again) << again.error().message();
  EXPECT_EQ(again->ids, result.segments.ids);
}

TEST_F(ObjectsOnSupportsTest, ThesisRuleTakesSegmentsAsTheyAre) {
  const FrameResult result = process(LabelingParams::Rule::thesis);
  EXPECT_TRUE(result.segments.roles.empty());
  EXPECT_TRUE(result.segments.is_estimated.empty());
  EXPECT_EQ(regionIn(result, kSheetOnTable), regionIn(result, {20, 400, 60, 60}));
  EXPECT_FALSE(regionIn(result, kGlassOnTable));
}

}  // namespace
}  // namespace scantrove
