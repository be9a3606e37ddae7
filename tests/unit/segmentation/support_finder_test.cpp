#include "core/segmentation/support_finder.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/segmentation/table_scene.h"

namespace scantrove {
namespace {

using test::TableScene;

/// A small box in the middle of the table.
TableScene tableWithBox(double half_side_m = TableScene::kFillsTheImage) {
  TableScene scene(half_side_m);
  scene.addBox({-0.03, -0.03, 0}, {0.03, 0.03, 0.05});
  return scene;
}

std::vector<Support> supportsOf(const TableScene& scene) {
  return findSupports(scene.segments(), TableScene::kCamera);
}

TEST(FindSupports, FindsTheTable_WithItsNormal) {
  const TableScene scene = tableWithBox();
  const std::vector<Support> supports = supportsOf(scene);
  ASSERT_EQ(supports.size(), 1U);
  const Support& table = supports[0];
  EXPECT_EQ(table.segment, TableScene::kTable);
  const Eigen::Vector3d up = TableScene::camera().linear().transpose() * Eigen::Vector3d::UnitZ();
  EXPECT_LT((table.surface.normal().cast<double>() - up).norm(), 0.002) << table.surface.normal();
  const float z_m = scene.tableDepth(40, 200);
  const Intrinsics& K = TableScene::kCamera;
  const float x = (40 - K.cx) / K.fx, y = (200 - K.cy) / K.fy;
  EXPECT_NEAR(table.surface.height(x, y, z_m), 0, 0.0005);
}

TEST(FindSupports, AreaIncludesWhatStandsOnTheTable) {
  const std::vector<Support> supports = supportsOf(tableWithBox(0.3));
  ASSERT_EQ(supports.size(), 1U);
  const Support& table = supports[0];
  ASSERT_EQ(table.area.size(), cv::Size(320, 240));
  EXPECT_EQ(table.area(TableScene::pixelOf({0, 0, 0.05})), 255) << "the box's top";
  EXPECT_EQ(table.area(TableScene::pixelOf({-0.25, -0.25, 0})), 255) << "the table's corner";
  EXPECT_EQ(table.area(5, 5), 0) << "beside the table";
  EXPECT_TRUE(table.box.contains(TableScene::pixelOf({0.25, 0.25, 0})));
  EXPECT_FALSE(table.box.contains({5, 5}));
}

TEST(FindSupports, FindsNone_WhenThePlaneCarriesNothing) {
  EXPECT_TRUE(supportsOf(TableScene()).empty());
  EXPECT_TRUE(supportsOf(TableScene(0.3)).empty());
}

TEST(FindSupports, FindsNone_WhenWhatTheTableCarriesIsFlat) {
  TableScene scene;
  scene.addBox({-0.03, -0.03, 0}, {0.03, 0.03, 0.005});
  EXPECT_TRUE(supportsOf(scene).empty());
}

TEST(FindSupports, FindsNone_WhenThePlaneIsSmallInTheImage) {
  const TableScene small = tableWithBox(0.12), large = tableWithBox(0.3);
  const double least = 0.08 * TableScene::kCamera.pixels();
  ASSERT_LT(small.segments().areas[TableScene::kTable], least);
  ASSERT_GT(large.segments().areas[TableScene::kTable], least);
  EXPECT_TRUE(supportsOf(small).empty());
  EXPECT_EQ(supportsOf(large).size(), 1U);
}

TEST(FindSupports, FindsNone_WhenTheSegmentIsNotFlat) {
  const TableScene scene = tableWithBox();
  SegmentMap segments = scene.segments();
  for (int v = 0; v < segments.height; ++v) {
    for (int u = 0; u < segments.width; ++u) {
      const float from_middle_px = std::hypot(static_cast<float>(u) - 159.5F, static_cast<float>(v) - 119.5F);
      constexpr float kWave_px = 20, kWave_m = 0.1F;
      segments.depths_m[TableScene::kCamera.indexOf(u, v)] += kWave_m * std::sin(from_middle_px / kWave_px);
    }
  }
  EXPECT_TRUE(findSupports(segments, TableScene::kCamera).empty());
}

}  // namespace
}  // namespace scantrove
