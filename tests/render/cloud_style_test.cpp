#include "ui/scene/cloud_style.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

constexpr RegionId kCup{7}, kTable{9};

CloudBrick::Point redPoint() {
  CloudBrick::Point point{0, -1, 0, FragmentId{1}};
  point.color = PackedColor::of(200, 40, 20);
  point.normal = PackedNormal::of(-Eigen::Vector3f::UnitY());
  return point;
}

TEST(PointColor, IsSceneRegionOrBlendedColor) {
  CloudStyle style;
  style.coloring = Coloring::scene;
  EXPECT_EQ(pointColor(style, redPoint(), kCup, 1), (Rgb{200, 40, 20}));
  style.coloring = Coloring::regions;
  EXPECT_EQ(pointColor(style, redPoint(), kCup, 1), regionColor(kCup));
  style.coloring = Coloring::blended;
  const Rgb blended = pointColor(style, redPoint(), kCup, 1);
  for (std::size_t c = 0; c < 3; ++c) {
    const int scene = redPoint().color.rgb[c];
    EXPECT_NEAR(blended[c], (scene + regionColor(kCup)[c]) / 2, 1);
  }
}

TEST(PointColor, OfTheSceneDependsLittleOnLight) {
  CloudStyle style;
  style.coloring = Coloring::scene;
  const Rgb dark = pointColor(style, redPoint(), kCup, 0.6F);
  EXPECT_GE(dark[0], 180);
  EXPECT_LT(dark[0], 200);
}

TEST(PointColor, IsGray_WithoutColor) {
  CloudStyle style;
  style.coloring = Coloring::scene;
  CloudBrick::Point point = redPoint();
  point.color = {};
  EXPECT_GT(pointColor(style, point, kCup, 1)[1], 100);
}

TEST(PointColor, EncodesNormals) {
  CloudStyle style;
  style.coloring = Coloring::normals;
  CloudBrick::Point point = redPoint();
  EXPECT_GT(pointColor(style, point, kCup, 1)[2], 250) << "normals that point up are blue";
  point.normal = PackedNormal::of(Eigen::Vector3f::UnitY());
  EXPECT_LT(pointColor(style, point, kCup, 1)[2], 5);
  point.normal = PackedNormal::of(Eigen::Vector3f::UnitX());
  EXPECT_NEAR(pointColor(style, point, kCup, 1)[2], 128, 2);
}

TEST(PointColor, EncodesHeights_AlongUp) {
  CloudStyle style;
  style.coloring = Coloring::height;
  style.low_m = 0;
  style.high_m = 1;
  EXPECT_EQ(pointColor(style, redPoint(), kCup, 1), heightColor(1));
  style.up = Eigen::Vector3f::UnitX();
  EXPECT_EQ(pointColor(style, redPoint(), kCup, 1), heightColor(0));
  EXPECT_NE(heightColor(0), heightColor(1));
  EXPECT_EQ(heightColor(-3), heightColor(0));
  EXPECT_EQ(heightColor(3), heightColor(1));
}

TEST(PointColor, DimsOrHidesBackground) {
  CloudStyle style;
  style.background = {kTable};
  EXPECT_EQ(pointColor(style, redPoint(), kTable, 1), regionColor(kTable));
  style.background_style = BackgroundStyle::dimmed;
  style.backdrop = {0, 0, 0};
  const Rgb dimmed = pointColor(style, redPoint(), kTable, 1);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_LT(dimmed[c], 90);
  EXPECT_EQ(pointColor(style, redPoint(), kCup, 1), regionColor(kCup));
  EXPECT_FALSE(style.hides(kTable));
  style.background_style = BackgroundStyle::hidden;
  EXPECT_TRUE(style.hides(kTable));
  EXPECT_FALSE(style.hides(kCup));
}

}  // namespace
}  // namespace scantrove
