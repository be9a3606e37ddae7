#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <set>

#include "core/pipeline/mapping_pipeline.h"

namespace scantrove {
namespace {

constexpr Intrinsics kOverTable{570, 570, 319.5F, 239.5F, 640, 480};
const cv::Rect kBox(270, 190, 100, 100);  // rises by 8 cm
const cv::Rect kSheet(80, 80, 100, 70);   // of paper: has no height
const cv::Rect kGlass(450, 320, 60, 80);  // has no depth
const cv::Scalar kWood(90, 140, 190), kPaper(240, 240, 240), kBlue(160, 60, 40);

/// A table from above, 1 m away, with a box, a sheet of paper and something without depth.
RgbdFrame tableFrame() {
  RgbdFrame frame;
  frame.depth = cv::Mat(480, 640, CV_16UC1, cv::Scalar(1000));
  frame.depth(kBox).setTo(920);
  frame.depth(kGlass).setTo(0);
  frame.color = cv::Mat(480, 640, CV_8UC3, kWood);
  frame.color(kBox).setTo(cv::Scalar(60, 160, 60));
  frame.color(kSheet).setTo(kPaper);
  frame.color(kGlass).setTo(kBlue);
  return frame;
}

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
  for (const cv::Rect& place : {kBox, kSheet, kGlass}) regions.insert(regionIn(result, place));
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
  EXPECT_EQ(regionIn(result, kSheet), regionIn(result, {20, 400, 60, 60}));
  EXPECT_FALSE(regionIn(result, kGlass));
}

}  // namespace
}  // namespace scantrove
