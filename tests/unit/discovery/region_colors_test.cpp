#include "core/discovery/region_colors.h"

#include <gmock/gmock.h>

#include "tests/unit/discovery/painted_scene.h"

namespace scantrove {
namespace {

using test::kGrayLab;
using test::kRedLab;
using test::PaintedScene;

const cv::Rect kPlace{60, 40, 30, 20};

ColorLikeness likenessOf(const PaintedScene& scene, const RegionSet& regions) {
  const DiscoveryInput input = scene.input();
  const auto likeness = RegionColors(input).likenessOf(regions, scene.extentOf(regions));
  EXPECT_TRUE(likeness);
  return likeness.value_or(ColorLikeness{-1, -1});
}

/// An object at a distance of `z_m` before a grey wall at 2 m.
PaintedScene beforeGrayWall(float z_m, const Eigen::Vector3f& color) {
  PaintedScene scene;
  scene.paint(7, kPlace, [z_m](int, int) { return z_m; });
  scene.color(1, kGrayLab);
  scene.color(7, color);
  return scene;
}

TEST(RegionColors, LikenessIsNone_WithoutColor) {
  PaintedScene scene;
  scene.paint(7, kPlace, [](int, int) { return 1.0F; });
  const DiscoveryInput input = scene.input();
  EXPECT_FALSE(RegionColors(input).likenessOf({RegionId{7}}, scene.extentOf({RegionId{7}})));
}

TEST(RegionColors, LikenessIsOne_ForAPatchOfTheWall) {
  const ColorLikeness likeness = likenessOf(beforeGrayWall(2, kGrayLab), {RegionId{7}});
  EXPECT_FLOAT_EQ(likeness.neighbor, 1);
  EXPECT_FLOAT_EQ(likeness.touching, 1);
}

TEST(RegionColors, LikenessIsZero_ForARedObjectOnAGrayWall) {
  const ColorLikeness likeness = likenessOf(beforeGrayWall(2, kRedLab), {RegionId{7}});
  EXPECT_EQ(likeness.neighbor, 0);
  EXPECT_EQ(likeness.touching, 0);
}

TEST(RegionColors, TouchingIgnoresSurfaceFarBehind) {
  const ColorLikeness likeness = likenessOf(beforeGrayWall(1, kGrayLab), {RegionId{7}});
  EXPECT_FLOAT_EQ(likeness.neighbor, 1) << "it is still its neighbour in the image";
  EXPECT_EQ(likeness.touching, 0);
}

TEST(RegionColors, NeighborIsTheMostSimilarOne) {
  PaintedScene scene = beforeGrayWall(2, kRedLab);
  const cv::Rect beside(kPlace.br().x, kPlace.y, 30, kPlace.height);
  scene.paint(8, beside, [](int, int) { return 2.0F; });
  scene.color(8, kRedLab);
  const ColorLikeness alone = likenessOf(scene, {RegionId{7}});
  EXPECT_NEAR(alone.neighbor, 1, 1e-4);
  EXPECT_GT(alone.touching, 0.1F);
  EXPECT_LT(alone.touching, 0.4F) << "one side of four touches the neighbour";
  const ColorLikeness both = likenessOf(scene, {RegionId{7}, RegionId{8}});
  EXPECT_EQ(both.neighbor, 0);
  EXPECT_EQ(both.touching, 0);
}

TEST(RegionColors, NeighborIsIgnored_WhenFewPixelsAreNear) {
  PaintedScene scene = beforeGrayWall(2, kRedLab);
  scene.paint(8, {kPlace.br().x, kPlace.y, 1, 7}, [](int, int) { return 2.0F; });
  scene.color(8, kRedLab);
  EXPECT_EQ(likenessOf(scene, {RegionId{7}}).neighbor, 0);
}

TEST(RegionColors, HalvesAreEqual_WithOneColor) {
  const ColorLikeness likeness = likenessOf(beforeGrayWall(1, kRedLab), {RegionId{7}});
  EXPECT_NEAR(likeness.end_to_end, 1, 1e-4);
  EXPECT_NEAR(likeness.side_to_side, 1, 1e-4);
}

TEST(RegionColors, EndToEndIsZero_ForTwoObjectsInARow) {
  PaintedScene scene = beforeGrayWall(1, kRedLab);
  const cv::Rect beside(kPlace.br().x, kPlace.y, kPlace.width, kPlace.height);
  scene.paint(8, beside, [](int, int) { return 1.0F; });
  scene.color(8, kGrayLab);
  const RegionSet both{RegionId{7}, RegionId{8}};
  const ColorLikeness likeness = likenessOf(scene, both);
  EXPECT_EQ(likeness.end_to_end, 0);
  EXPECT_NEAR(likeness.side_to_side, 1, 1e-4) << "half of each half is red";
}

TEST(RegionColors, EndToEndIsZero_ForASlantedRow) {
  // Steps down to the right, red and then grey: the longer axis is their diagonal.
  PaintedScene scene = beforeGrayWall(1, kRedLab);
  const cv::Rect below(kPlace.br().x, kPlace.br().y, kPlace.width, kPlace.height);
  scene.paint(8, below, [](int, int) { return 1.0F; });
  scene.color(8, kGrayLab);
  const ColorLikeness likeness = likenessOf(scene, {RegionId{7}, RegionId{8}});
  EXPECT_EQ(likeness.end_to_end, 0);
  EXPECT_GT(likeness.side_to_side, 0.8F) << "the axis divides each object into near-equal halves";
}

TEST(RegionColors, TouchingIsOne_AtTheImageEdge) {
  PaintedScene scene;
  const cv::Rect corner(0, 0, 30, 20);
  scene.paint(7, corner, [](int, int) { return 2.0F; });
  scene.color(1, kGrayLab);
  scene.color(7, kGrayLab);
  EXPECT_FLOAT_EQ(likenessOf(scene, {RegionId{7}}).touching, 1);
}

}  // namespace
}  // namespace scantrove
