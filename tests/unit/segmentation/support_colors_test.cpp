#include "core/segmentation/support_colors.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <random>

namespace scantrove {
namespace {

/// Colours of a support that fills the image; all of it is measured and compared.
struct ColoredSupport {
  static constexpr float kClear = 4;  // from here on a pixel is of an object
  cv::Mat3f lab;
  cv::Mat1b all = cv::Mat1b(cv::Size(160, 120), 255);

  explicit ColoredSupport(const cv::Vec3f& color) : lab(cv::Size(160, 120), color) {}

  ColoredSupport& paint(const cv::Rect& where, const cv::Vec3f& color) {
    lab(where).setTo(cv::Scalar(static_cast<double>(color[0]), static_cast<double>(color[1]),
                                static_cast<double>(color[2])));
    return *this;
  }
  /// Adds grain that is uniform within these limits.
  ColoredSupport& addGrain(const cv::Vec3f& limits) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> part(-1, 1);
    for (cv::Vec3f& pixel : lab)
      for (int channel = 0; channel < 3; ++channel) pixel[channel] += part(random) * limits[channel];
    return *this;
  }
  [[nodiscard]] SupportColorDifference difference() const { return differenceFromSupport(lab, all, all); }
};

const cv::Rect kColorPatch(60, 50, 30, 24);
const cv::Point kInPatch(75, 62), kOffPatch(20, 20);

void expectDifferencesBelow(float limit, const cv::Mat1f& image) {
  double most = 0;
  cv::minMaxLoc(image, nullptr, &most);
  EXPECT_LT(most, static_cast<double>(limit));
}

TEST(DifferenceFromSupport, IsSmall_OnAPatternedSupport) {
  const cv::Vec3f color(60, 5, 10), grain(12, 8, 8);
  const SupportColorDifference patterned = ColoredSupport(color).addGrain(grain).difference();
  expectDifferencesBelow(ColoredSupport::kClear, patterned.lit);
  expectDifferencesBelow(ColoredSupport::kClear, patterned.shaded);
  // The same colours are those of an object on a plain support.
  const SupportColorDifference plain = ColoredSupport(color).paint(kColorPatch, color + grain).difference();
  EXPECT_GT(plain.lit(kInPatch), ColoredSupport::kClear);
}

TEST(DifferenceFromSupport, IsClear_WhereTheColorDiffers) {
  const SupportColorDifference difference =
      ColoredSupport({60, 5, 10}).paint(kColorPatch, {60, 35, 10}).difference();
  for (const cv::Mat1f& image : {difference.lit, difference.shaded}) {
    double least = 0;
    cv::minMaxLoc(image(kColorPatch), &least);
    EXPECT_GT(least, static_cast<double>(ColoredSupport::kClear));
    cv::Mat1f outside = image.clone();
    outside(kColorPatch).setTo(0);
    expectDifferencesBelow(0.5F, outside);
  }
}

TEST(DifferenceFromSupport, IsSmallOnlyWhenShaded_InAShadow) {
  const cv::Vec3f color(80, 5, 10);
  const SupportColorDifference difference =
      ColoredSupport(color).paint(kColorPatch, 0.6F * color).difference();
  EXPECT_GT(difference.lit(kInPatch), ColoredSupport::kClear);
  EXPECT_LT(difference.shaded(kInPatch), 0.5F);
  EXPECT_LT(difference.lit(kOffPatch), 0.5F);
}

TEST(DifferenceFromSupport, IsSmall_InSlightShadeAndInAHighlight) {
  const cv::Vec3f color(60, 5, 10), white(100, 0, 0);
  for (const cv::Vec3f& light : {cv::Vec3f(0.9F * color), cv::Vec3f(color + 0.2F * (white - color))}) {
    const SupportColorDifference difference = ColoredSupport(color).paint(kColorPatch, light).difference();
    EXPECT_LT(difference.lit(kInPatch), 0.5F) << light;
  }
}

TEST(DifferenceFromSupport, IsZero_OutsideTheArea) {
  ColoredSupport support({60, 5, 10});
  support.paint(kColorPatch, {60, 35, 10});
  cv::Mat1b area = support.all.clone();
  area(cv::Rect(0, 0, 75, 120)).setTo(0);
  const SupportColorDifference difference = differenceFromSupport(support.lab, support.all, area);
  EXPECT_EQ(difference.lit(60, 70), 0);
  EXPECT_EQ(difference.shaded(60, 70), 0);
  EXPECT_GT(difference.lit(60, 80), ColoredSupport::kClear);
}

TEST(DifferenceFromSupport, IsZero_WithoutColor) {
  const cv::Mat1b all(cv::Size(160, 120), 255);
  const SupportColorDifference difference = differenceFromSupport(cv::Mat3f(), all, all);
  for (const cv::Mat1f& image : {difference.lit, difference.shaded}) {
    ASSERT_EQ(image.size(), all.size());
    EXPECT_EQ(cv::countNonZero(image), 0);
  }
}

}  // namespace
}  // namespace scantrove
