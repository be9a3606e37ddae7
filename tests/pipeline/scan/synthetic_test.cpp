#include <gtest/gtest.h>

#include "tests/support/synthetic_scan.h"
#include "tests/support/test_scenes.h"

namespace scantrove {
namespace {

using test::SyntheticScan;

SyntheticOptions optionsOf(synthetic::SceneRecipe (*recipe)(), int frames) {
  SyntheticOptions options;
  options.recipe = recipe;
  options.frames = frames;
  return options;
}

// The central claims of the thesis on a scene with exact truth: poses are right, and merging over time gives
// better boundaries than single frames (table 4.1).
TEST(SyntheticTabletop, TracksWithinTenMillimeters_AndMergingImprovesBoundaries) {
  SyntheticScan scan(optionsOf(synthetic::makeTabletopScene, 100));
  scan.run();
  ASSERT_EQ(scan.frames.size(), 100U);
  for (const auto& frame : scan.frames) EXPECT_TRUE(frame.pose.usable());
  const double ate = scan.trajectoryError();
  RecordProperty("ate_mm", std::to_string(1000 * ate));
  EXPECT_LT(ate, 0.010);

  std::vector<SegmentationMetrics> single;
  std::vector<SegmentationMetrics> merged;
  for (std::size_t i = 20; i < scan.frames.size(); i += 4) {  // too little is merged in the first frames
    const auto& frame = scan.frames[i];
    single.push_back(evaluateSegmentation(frame.segments, frame.instances));
    // Regions as known at the frame: both images have the same pixels without surface.
    merged.push_back(evaluateSegmentation(frame.regions, frame.instances));
  }
  const double single_error = averaged(single).boundary_error;
  const double merged_error = averaged(merged).boundary_error;
  RecordProperty("boundary_error_single", std::to_string(single_error));
  RecordProperty("boundary_error_merged", std::to_string(merged_error));
  std::cout << "ATE " << 1000 * ate << " mm; boundary error single " << single_error << ", merged "
            << merged_error << "; coverage single " << averaged(single).coverage << ", merged "
            << averaged(merged).coverage << '\n';
  EXPECT_LT(merged_error, single_error);
}

// Thesis 4.3: segments of a non-convex object merge once a convex connection was seen.
TEST(SyntheticLBlock, SegmentsMergeIntoOneRegion) {
  SyntheticScan scan(optionsOf(test::makeLBlockScene, 0));
  scan.run();
  ASSERT_GE(scan.frames.size(), 100U);
  const int block = scan.source().scene().find("L block");
  ASSERT_GT(block, 0);
  const auto& first = scan.frames.front();
  EXPECT_GE(SyntheticScan::labelsOf(first.segments, first.instances, block, 0.15).size(), 2U);
  const auto& last = scan.frames.back();
  EXPECT_EQ(SyntheticScan::labelsOf(scan.finalRegions(last), last.instances, block, 0.05).size(), 1U);
  // The block is not merged with the table.
  const int table = scan.source().scene().find("table");
  ASSERT_GT(table, 0);
  const cv::Mat regions = scan.finalRegions(last);
  EXPECT_NE(SyntheticScan::labelsOf(regions, last.instances, block, 0.5),
            SyntheticScan::labelsOf(regions, last.instances, table, 0.5));
}

// Thesis 4.5: the floor that a chair splits becomes one region and stays one.
TEST(SyntheticChairFloor, FloorSplitByTheChairBecomesOneRegion) {
  SyntheticScan scan(optionsOf(test::makeChairFloorScene, 0));
  scan.run();
  const int floor = 1;
  const auto& first = scan.frames.front();
  EXPECT_GE(SyntheticScan::labelsOf(first.segments, first.instances, floor, 0.05).size(), 2U)
      << "the first frame does not show the floor in pieces";
  const auto& last = scan.frames.back();
  EXPECT_EQ(SyntheticScan::labelsOf(scan.finalRegions(last), last.instances, floor, 0.02).size(), 1U);
  const int chair = scan.source().scene().find("chair");
  ASSERT_GT(chair, 0);
  const cv::Mat regions = scan.finalRegions(last);
  const auto floor_label = SyntheticScan::labelsOf(regions, last.instances, floor, 0.5);
  for (const int label : SyntheticScan::labelsOf(regions, last.instances, chair, 0.3)) {
    EXPECT_NE(label, floor_label.at(0)) << "a part of the chair is merged with the floor";
  }
}

}  // namespace
}  // namespace scantrove
