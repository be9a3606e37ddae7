#include "core/discovery/region_appearance.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace scantrove {
namespace {

/// Points on the sides of a box, in one colour or without colour.
std::vector<AppearancePoint> box(const Eigen::Vector3f& size_m, const std::array<std::uint8_t, 3>& rgb,
                                 const Eigen::Matrix3f& R = Eigen::Matrix3f::Identity(),
                                 bool has_color = true) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(-0.5F, 0.5F);
  std::vector<AppearancePoint> points;
  for (int i = 0; i < 3000; ++i) {
    Eigen::Vector3f position(unit(random), unit(random), unit(random));
    position[i % 3] = i % 2 == 0 ? 0.5F : -0.5F;
    points.push_back({R * position.cwiseProduct(size_m) + Eigen::Vector3f(1, 2, 3), rgb, has_color});
  }
  return points;
}

const std::array<std::uint8_t, 3> kRed{200, 40, 40}, kDarkRed{170, 30, 35}, kBlue{40, 60, 190};

TEST(RegionAppearance, LikenessIsHigh_WhenTheObjectIsTurned) {
  const Eigen::Matrix3f R =
      Eigen::AngleAxisf(0.7F, Eigen::Vector3f(1, 2, 0.5F).normalized()).toRotationMatrix();
  EXPECT_GT(
      likeness(appearanceOf(box({0.1F, 0.08F, 0.2F}, kRed)), appearanceOf(box({0.1F, 0.08F, 0.2F}, kRed, R))),
      0.9F);
}

TEST(RegionAppearance, LikenessIsHighInShadowAndLow_WithAnotherColorOrSize) {
  const RegionAppearance mug = appearanceOf(box({0.1F, 0.08F, 0.1F}, kRed));
  const float in_shadow = likeness(mug, appearanceOf(box({0.1F, 0.08F, 0.1F}, kDarkRed)));
  const float other_color = likeness(mug, appearanceOf(box({0.1F, 0.08F, 0.1F}, kBlue)));
  const float other_size = likeness(mug, appearanceOf(box({0.4F, 0.3F, 0.2F}, kRed)));
  EXPECT_GT(in_shadow, 0.6F);
  EXPECT_LT(other_color, 0.3F);
  EXPECT_LT(other_size, 0.6F);
}

TEST(RegionAppearance, LikenessIsThatOfSizes_WithoutColor) {
  const auto gray = [](const Eigen::Vector3f& size_m) {
    return appearanceOf(box(size_m, kRed, Eigen::Matrix3f::Identity(), false));
  };
  EXPECT_GT(likeness(gray({0.1F, 0.08F, 0.1F}), gray({0.1F, 0.08F, 0.1F})), 0.9F);
  EXPECT_LT(likeness(gray({0.1F, 0.08F, 0.1F}), gray({0.8F, 0.6F, 0.1F})), 0.3F);
}

// Without this rule, a strip of table behind a vase ranked before books: it has a book's size and no colour.
TEST(RegionAppearance, LikenessIsLow_WhenOnlyOneHasColor) {
  const RegionAppearance book = appearanceOf(box({0.18F, 0.12F, 0.04F}, kRed));
  const RegionAppearance strip =
      appearanceOf(box({0.17F, 0.12F, 0.02F}, kRed, Eigen::Matrix3f::Identity(), false));
  const RegionAppearance other_book = appearanceOf(box({0.2F, 0.14F, 0.05F}, kDarkRed));
  EXPECT_LT(likeness(book, strip), 0.45F);  // the least likeness that RegionProposals proposes
  EXPECT_LT(likeness(book, strip), likeness(book, other_book));
}

TEST(RegionAppearance, IsEmpty_WithoutPoints) {
  const RegionAppearance none = appearanceOf({});
  EXPECT_EQ(none.size_m, Eigen::Vector3f::Zero());
  EXPECT_TRUE(none.colors.isEmpty());
}

}  // namespace
}  // namespace scantrove
