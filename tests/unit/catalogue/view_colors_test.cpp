#include "core/catalogue/view_colors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace scantrove {
namespace {

using Shares = std::vector<double>;

/// Shares by definition: each pixel counts in the two nearest bins of each axis, by linear interpolation
/// between their middles.
Shares sharesOf(const std::vector<cv::Vec3b>& pixels) {
  cv::Mat bgr, lab;
  cv::Mat(pixels).reshape(3, 1).convertTo(bgr, CV_32FC3, 1.0 / 255);
  cv::cvtColor(bgr, lab, cv::COLOR_BGR2Lab);
  const auto weight = [](double value, double lowest, double highest, std::size_t bin, std::size_t bins) {
    const double last = static_cast<double>(bins) - 1, at = static_cast<double>(bin);
    const double place = (value - lowest) / (highest - lowest) * static_cast<double>(bins) - 0.5;
    return std::max(0.0, 1 - std::abs(std::clamp(place, 0.0, last) - at));
  };
  Shares shares;
  for (std::size_t l = 0; l < 5; ++l) {
    for (std::size_t a = 0; a < 11; ++a) {
      for (std::size_t b = 0; b < 11; ++b) {
        double sum = 0;
        for (int i = 0; i < lab.cols; ++i) {
          const auto& v = lab.at<cv::Vec3f>(i);
          sum += weight(v[0], 0, 100, l, 5) * weight(v[1], -66, 66, a, 11) * weight(v[2], -66, 66, b, 11);
        }
        shares.push_back(sum / lab.cols);
      }
    }
  }
  return shares;
}

cv::Mat noise(const cv::Size& size, std::uint64_t seed, int lowest = 0, int highest = 256) {
  cv::RNG random(seed);
  cv::Mat image(size, CV_8UC3);
  random.fill(image, cv::RNG::UNIFORM, lowest, highest);
  return image;
}

cv::Mat filled(const cv::Size& size, const cv::Scalar& color) { return {size, CV_8UC3, color}; }
cv::Mat all(const cv::Size& size) { return {size, CV_8UC1, cv::Scalar(255)}; }

void expectShares(const ViewColors& colors, const Shares& expected) {
  // The last bin is shortened by a thousandth of a bin (SoftBin), and roots are rounded to 1/255.
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(colors.roots[i] / 255.0, std::sqrt(expected[i]), 0.006) << "bin " << i;
}

TEST(ViewColors, HoldRootsOfTheShares) {
  const cv::Size size(12, 10);
  const cv::Mat color = noise(size, 3, 70, 190);
  std::vector<cv::Vec3b> inner;
  for (int y = 1; y < 9; ++y) {
    for (int x = 1; x < 11; ++x) inner.push_back(color.at<cv::Vec3b>(y, x));
  }
  const std::optional<ViewColors> colors = describeColors(color, all(size));
  ASSERT_TRUE(colors);
  expectShares(*colors, sharesOf(inner));
}

TEST(ViewColors, LeaveOutBackgroundAndOutline) {
  const cv::Size size(30, 30);
  const cv::Mat plain = filled(size, {40, 90, 200});
  cv::Mat mask(size, CV_8UC1, cv::Scalar(0)), painted = plain.clone();
  const cv::Rect object(5, 5, 20, 20);
  mask(object).setTo(255);
  painted.setTo(cv::Scalar(250, 10, 10), mask == 0);
  cv::rectangle(painted, object, cv::Scalar(250, 10, 10));
  EXPECT_EQ(describeColors(painted, mask)->roots, describeColors(plain, mask)->roots);
}

TEST(ViewColors, KeepTheOutline_WhenLittleElseRemains) {
  const cv::Size size(60, 3);
  cv::Mat pen = filled(size, {200, 60, 30});
  pen.row(1).setTo(cv::Scalar(50, 60, 180));
  cv::Mat mask(cv::Size(30, 3), CV_8UC1, cv::Scalar(255));
  const cv::Mat part = pen.colRange(0, 30);
  std::vector<cv::Vec3b> pixels;
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 30; ++x) pixels.push_back(part.at<cv::Vec3b>(y, x));
  }
  expectShares(*describeColors(part, mask), sharesOf(pixels));
}

TEST(ViewColors, OfALargePictureAreThoseOfASmallOne) {
  const cv::Mat small = noise({40, 40}, 8, 60, 200);
  cv::Mat large;
  cv::repeat(small, 12, 12, large);
  const float distance =
      colorDistance(*describeColors(small, all(small.size())), *describeColors(large, all(large.size())));
  EXPECT_LT(distance, 0.02F);
}

TEST(ViewColors, AreNone_WithoutColorOrMaskedPixels) {
  EXPECT_FALSE(describeColors(noise({9, 9}, 1), cv::Mat(9, 9, CV_8UC1, cv::Scalar(0))));
  EXPECT_FALSE(describeColors({}, {}));
}

TEST(ColorDistance, IsTheSquaredHellingerDistance) {
  ViewColors a, b;
  a.roots[0] = 153, a.roots[7] = 204;    // shares 0.36 and 0.64
  b.roots[7] = 204, b.roots[600] = 153;  // 0.64 in common
  EXPECT_NEAR(colorDistance(a, b), 1 - 0.64, 1e-5);
  EXPECT_NEAR(colorDistance(a, a), 0, 1e-6);
  ViewColors c;
  c.roots[3] = 255;
  EXPECT_EQ(colorDistance(a, c), 1);
  EXPECT_EQ(colorDistance(a, ViewColors{}), 1);
}

TEST(ColorDistance, ToleratesLightMoreThanAnotherColor) {
  const cv::Size size(20, 20);
  const auto colorsOf = [&](const cv::Scalar& bgr) { return *describeColors(filled(size, bgr), all(size)); };
  const ViewColors red = colorsOf({30, 30, 160}), bright_red = colorsOf({36, 36, 190}),
                   green = colorsOf({30, 160, 30});
  EXPECT_LT(colorDistance(red, bright_red), 0.7F);
  EXPECT_EQ(colorDistance(red, green), 1);
}

}  // namespace
}  // namespace scantrove
