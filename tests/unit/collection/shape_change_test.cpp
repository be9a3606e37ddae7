#include "core/collection/shape_change.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

using Kind = ShapeChange::Kind;

RegionAppearance thing(float a_m, float b_m, float c_m, const Eigen::Vector3f& lab = {60, 40, 20}) {
  RegionAppearance appearance;
  appearance.size_m = {a_m, b_m, c_m};
  for (int i = 0; i < 100; ++i) appearance.colors.add(lab);
  return appearance;
}

TEST(ShapeChange, IsNone_WhenTheBoxChangesByLessThanHalf) {
  EXPECT_FALSE(changeOf(thing(0.2F, 0.1F, 0.1F), thing(0.2F, 0.1F, 0.1F)));
  EXPECT_FALSE(changeOf(thing(0.2F, 0.1F, 0.1F), thing(0.29F, 0.1F, 0.1F)));
  EXPECT_FALSE(changeOf(thing(0.2F, 0.1F, 0.1F), thing(0.11F, 0.1F, 0.1F)));
}

TEST(ShapeChange, SaysHowMuchLargerOrSmaller) {
  const auto larger = changeOf(thing(0.2F, 0.1F, 0.1F), thing(0.2F, 0.2F, 0.1F));
  ASSERT_TRUE(larger);
  EXPECT_EQ(larger->kind, Kind::larger);
  EXPECT_FLOAT_EQ(larger->volume, 2);
  const auto smaller = changeOf(thing(0.2F, 0.1F, 0.1F), thing(0.1F, 0.08F, 0.1F));
  ASSERT_TRUE(smaller);
  EXPECT_EQ(smaller->kind, Kind::smaller);
  EXPECT_FLOAT_EQ(smaller->volume, 0.4F);
}

TEST(ShapeChange, IgnoresTheThicknessOfFlatThings) {
  EXPECT_FALSE(changeOf(thing(0.3F, 0.2F, 0.004F), thing(0.3F, 0.2F, 0.02F)));
}

TEST(ShapeChange, IsOtherColors_WhenMostOfTheSurfaceHasThem) {
  const auto changed = changeOf(thing(0.2F, 0.1F, 0.1F), thing(0.2F, 0.1F, 0.1F, {60, -40, 20}));
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->kind, Kind::other_colors);
  RegionAppearance partly = thing(0.2F, 0.1F, 0.1F);
  for (int i = 0; i < 40; ++i) partly.colors.add({60, -40, 20});  // 29 % of its surface
  EXPECT_FALSE(changeOf(thing(0.2F, 0.1F, 0.1F), partly));
}

TEST(ShapeChange, IsNone_WhenSomethingIsUnknown) {
  RegionAppearance without_color;
  without_color.size_m = {0.2F, 0.1F, 0.1F};
  EXPECT_FALSE(changeOf(thing(0.2F, 0.1F, 0.1F), without_color));
  EXPECT_FALSE(changeOf(thing(0.2F, 0.1F, 0.1F), RegionAppearance{}));
}

}  // namespace
}  // namespace scantrove
