#include "core/editing/magic_edge.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

namespace scantrove::test {
namespace {

double overlapOf(const cv::Mat& a, const cv::Mat& b) {
  return cv::countNonZero(a & b) / static_cast<double>(cv::countNonZero(a | b));
}

/// A disc of another colour, with noise.
struct Disc {
  cv::Mat mask = cv::Mat::zeros(240, 320, CV_8UC1), color = cv::Mat(240, 320, CV_8UC3);
  Disc() {
    cv::circle(mask, {160, 120}, 60, 255, cv::FILLED);
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, 4);
    for (int y = 0; y < color.rows; ++y) {
      for (int x = 0; x < color.cols; ++x) {
        const bool is_inside = mask.at<std::uint8_t>(y, x) != 0;
        for (int c = 0; c < 3; ++c)
          color.at<cv::Vec3b>(y, x)[c] =
              cv::saturate_cast<std::uint8_t>((is_inside ? 90 + 30 * c : 130) + noise(random));
      }
    }
  }
};

cv::Mat whole(const SnappedMask& snapped, const cv::Size& size) {
  cv::Mat mask = cv::Mat::zeros(size, CV_8UC1);
  snapped.mask.copyTo(mask(snapped.box));
  return mask;
}

TEST(MagicEdge, MovesARoughOutlineToTheEdge) {
  const Disc disc;
  for (const int reach : {6, 14}) {
    cv::Mat rough = cv::Mat::zeros(disc.mask.size(), CV_8UC1);
    cv::ellipse(rough, {160, 120}, {60 + reach * 2 / 3, 60 - reach * 2 / 3}, 20, 0, 360, 255, cv::FILLED);
    const cv::Mat snapped = whole(snapToEdges(disc.color, rough, reach), rough.size());
    EXPECT_LT(overlapOf(rough, disc.mask), 0.93) << "the case is of use";
    EXPECT_GT(overlapOf(snapped, disc.mask), 0.97) << reach;
  }
}

TEST(MagicEdge, LeavesTheOutline_WhereTheImageIsPlain) {
  const cv::Mat plain(240, 320, CV_8UC3, cv::Scalar(120, 110, 100));
  const Disc disc;
  EXPECT_GT(overlapOf(whole(snapToEdges(plain, disc.mask, 6), disc.mask.size()), disc.mask), 0.95);
}

TEST(MagicEdge, ChangesNothingBeyondItsReach) {
  const Disc disc;
  cv::Mat rough = cv::Mat::zeros(disc.mask.size(), CV_8UC1);
  cv::circle(rough, {160, 120}, 45, 255, cv::FILLED);  // 15 pixels from the edge
  const cv::Mat snapped = whole(snapToEdges(disc.color, rough, 6), rough.size());
  cv::Mat inner, outer;
  cv::erode(rough, inner, cv::getStructuringElement(cv::MORPH_ELLIPSE, {17, 17}));
  cv::dilate(rough, outer, cv::getStructuringElement(cv::MORPH_ELLIPSE, {17, 17}));
  EXPECT_EQ(cv::countNonZero(inner & (snapped == 0)), 0);
  EXPECT_EQ(cv::countNonZero(snapped & (outer == 0)), 0);
}

TEST(MagicEdge, KeepsTheMiddleOfAThinStroke) {
  const Disc disc;
  cv::Mat stroke = cv::Mat::zeros(disc.mask.size(), CV_8UC1);
  cv::line(stroke, {130, 120}, {190, 120}, 255, 5);
  const cv::Mat snapped = whole(snapToEdges(disc.color, stroke, 6), stroke.size());
  for (int x = 132; x < 188; ++x) EXPECT_NE(snapped.at<std::uint8_t>(120, x), 0) << x;
}

TEST(MagicEdge, IsEmpty_WithoutAMask) {
  const Disc disc;
  EXPECT_TRUE(snapToEdges(disc.color, cv::Mat::zeros(disc.mask.size(), CV_8UC1), 6).box.empty());
  const cv::Mat all(disc.mask.size(), CV_8UC1, cv::Scalar::all(255));
  const SnappedMask snapped = snapToEdges(disc.color, all, 6);
  EXPECT_EQ(cv::countNonZero(snapped.mask), 320 * 240) << "no outline";
}

}  // namespace
}  // namespace scantrove::test
