#include "core/discovery/region_colors.h"

#include <gmock/gmock.h>

#include "tests/unit/discovery/painted_scene.h"

namespace scantrove {
namespace {

using test::PaintedScene;

// At bins: 25 apart.
const Eigen::Vector3f kGreyLab{50, 0, 0}, kRedLab{50, 50, 25};
const cv::Rect kPlace{60, 40, 30, 20};

ColorLikeness likenessOf(const PaintedScene& scene, const RegionSet& regions, const cv::Rect& box_px) {
  const DiscoveryInput input = scene.input();
  const auto likeness = RegionColors(input).likenessOf(regions, box_px);
  EXPECT_TRUE(likeness);
  return likeness.value_or(ColorLikeness{-1, -1});
}

/// Something at that distance before a grey wall at 2 m.
PaintedScene beforeGreyWall(float z_m, const Eigen::Vector3f& color) {
  PaintedScene scene;
  scene.paint(7, kPlace, [z_m](int, int) { return z_m; });
  scene.color(1, kGreyLab);
  scene.color(7, color);
  return scene;
}

TEST(RegionColors, OfAnImageWithoutColourNothingIsSaid) {
  PaintedScene scene;
  scene.paint(7, kPlace, [](int, int) { return 1.0F; });
  const DiscoveryInput input = scene.input();
  EXPECT_FALSE(RegionColors(input).likenessOf({RegionId{7}}, kPlace));
}

TEST(RegionColors, APatchOfTheWallIsLikeTheWall) {
  const ColorLikeness likeness = likenessOf(beforeGreyWall(2, kGreyLab), {RegionId{7}}, kPlace);
  EXPECT_FLOAT_EQ(likeness.neighbour, 1);
  EXPECT_FLOAT_EQ(likeness.touching, 1);
}

TEST(RegionColors, ARedThingOnItIsNot) {
  const ColorLikeness likeness = likenessOf(beforeGreyWall(2, kRedLab), {RegionId{7}}, kPlace);
  EXPECT_EQ(likeness.neighbour, 0);
  EXPECT_EQ(likeness.touching, 0);
}

TEST(RegionColors, WhatLiesFarBehindDoesNotTouchIt) {
  const ColorLikeness likeness = likenessOf(beforeGreyWall(1, kGreyLab), {RegionId{7}}, kPlace);
  EXPECT_FLOAT_EQ(likeness.neighbour, 1) << "but it is its neighbour in the image";
  EXPECT_EQ(likeness.touching, 0);
}

TEST(RegionColors, TheNeighbourMostLikeItCounts) {
  PaintedScene scene = beforeGreyWall(2, kRedLab);
  const cv::Rect beside(kPlace.br().x, kPlace.y, 30, kPlace.height);
  scene.paint(8, beside, [](int, int) { return 2.0F; });
  scene.color(8, kRedLab);
  const ColorLikeness alone = likenessOf(scene, {RegionId{7}}, kPlace);
  EXPECT_NEAR(alone.neighbour, 1, 1e-4);
  EXPECT_GT(alone.touching, 0.1F);
  EXPECT_LT(alone.touching, 0.4F) << "one side of four touches it";
  const ColorLikeness both = likenessOf(scene, {RegionId{7}, RegionId{8}}, kPlace | beside);
  EXPECT_EQ(both.neighbour, 0);
  EXPECT_EQ(both.touching, 0);
}

TEST(RegionColors, AFewPixelsNearItAreNoNeighbour) {
  PaintedScene scene = beforeGreyWall(2, kRedLab);
  scene.paint(8, {kPlace.br().x, kPlace.y, 1, 7}, [](int, int) { return 2.0F; });
  scene.color(8, kRedLab);
  EXPECT_EQ(likenessOf(scene, {RegionId{7}}, kPlace).neighbour, 0);
}

TEST(RegionColors, AtTheImagesEdgeToo) {
  PaintedScene scene;
  const cv::Rect corner(0, 0, 30, 20);
  scene.paint(7, corner, [](int, int) { return 2.0F; });
  scene.color(1, kGreyLab);
  scene.color(7, kGreyLab);
  EXPECT_FLOAT_EQ(likenessOf(scene, {RegionId{7}}, corner).touching, 1);
}

}  // namespace
}  // namespace scantrove
