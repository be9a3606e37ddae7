#include "core/editing/mask_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

namespace scantrove::test {
namespace {

using Points = std::vector<cv::Point2f>;

cv::Mat blank(int width = 60, int height = 40) { return cv::Mat::zeros(height, width, CV_8UC1); }

/// Distance from a point to the line through `points`, by the formula of each segment.
double distanceTo(const Points& points, double x, double y) {
  double least = std::hypot(x - points[0].x, y - points[0].y);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double dx = points[i + 1].x - points[i].x, dy = points[i + 1].y - points[i].y;
    const double length2 = dx * dx + dy * dy;
    const double along = ((x - points[i].x) * dx + (y - points[i].y) * dy) / length2;
    const double t = std::clamp(along, 0.0, 1.0);
    least = std::min(least, std::hypot(x - points[i].x - t * dx, y - points[i].y - t * dy));
  }
  return least;
}

TEST(MaskTools, StrokePaintsPixelsWithinItsRadius) {
  const std::array<Points, 4> lines{Points{{20.3F, 12.6F}}, Points{{5, 5}, {50.5F, 33.2F}},
                                    Points{{-10, 20}, {30, 20}, {30, 60}},
                                    Points{{10, 30}, {10.2F, 30.1F}, {55, 3}}};
  for (const Points& line : lines) {
    for (const float radius : {0.4F, 2.0F, 7.5F}) {
      cv::Mat mask = blank();
      const cv::Rect box = paintStroke(mask, line, radius, PaintMode::add);
      for (int y = 0; y < mask.rows; ++y) {
        for (int x = 0; x < mask.cols; ++x) {
          const double distance = distanceTo(line, x, y);
          if (std::abs(distance - radius) < 1e-4) continue;
          EXPECT_EQ(mask.at<std::uint8_t>(y, x) != 0, distance < radius) << x << "," << y << " " << radius;
          EXPECT_TRUE(mask.at<std::uint8_t>(y, x) == 0 || box.contains({x, y}));
        }
      }
    }
  }
}

TEST(MaskTools, EraserClearsWhatAStrokePaints) {
  cv::Mat mask(40, 60, CV_8UC1, cv::Scalar::all(255));
  const Points line{{10, 10}, {40, 30}};
  paintStroke(mask, line, 5, PaintMode::erase);
  cv::Mat painted = blank();
  paintStroke(painted, line, 5, PaintMode::add);
  EXPECT_EQ(cv::countNonZero(mask & painted), 0);
  EXPECT_EQ(cv::countNonZero(mask | painted), 40 * 60);
}

TEST(MaskTools, StrokeIsCut_WhenItLeavesTheImage) {
  cv::Mat mask = blank();
  EXPECT_TRUE(paintStroke(mask, Points{{500, 500}}, 3, PaintMode::add).empty());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(paintStroke(mask, Points{{nan, 5}}, 3, PaintMode::add).empty());
  EXPECT_TRUE(paintStroke(mask, Points{}, 3, PaintMode::add).empty());
  EXPECT_EQ(cv::countNonZero(mask), 0);
  paintStroke(mask, Points{{-1e30F, 20}, {1e30F, 20}}, 0.5F, PaintMode::add);
  EXPECT_EQ(cv::countNonZero(mask), 60) << "one row";
}

TEST(MaskTools, PolygonFollowsTheEvenOddRule) {
  cv::Mat mask = blank();
  const std::vector<Points> outlines{{{5.5F, 4.5F}, {45.5F, 4.5F}, {45.5F, 34.5F}, {5.5F, 34.5F}},
                                     {{15.5F, 14.5F}, {25.5F, 14.5F}, {25.5F, 24.5F}, {15.5F, 24.5F}}};
  const cv::Rect box = paintPolygon(mask, outlines, PaintMode::add);
  EXPECT_EQ(box & cv::Rect(5, 4, 41, 31), cv::Rect(5, 4, 41, 31));
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const bool in_outer = x > 5 && x <= 45 && y > 4 && y <= 34;
      const bool in_hole = x > 15 && x <= 25 && y > 14 && y <= 24;
      EXPECT_EQ(mask.at<std::uint8_t>(y, x) != 0, in_outer && !in_hole) << x << "," << y;
    }
  }
}

TEST(MaskTools, PolygonHasTheAreaOfATriangle) {
  cv::Mat mask = blank(400, 400);
  const std::vector<Points> triangle{{{20.3F, 30.1F}, {350.7F, 80.9F}, {120.2F, 360.4F}}};
  paintPolygon(mask, triangle, PaintMode::add);
  const Points& p = triangle[0];
  const double area =
      std::abs((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y)) / 2;
  EXPECT_NEAR(cv::countNonZero(mask), area, 0.005 * area);
  paintPolygon(mask, triangle, PaintMode::erase);
  EXPECT_EQ(cv::countNonZero(mask), 0);
}

TEST(MaskTools, FillsTheHoleAroundAPoint) {
  cv::Mat mask = blank();
  mask(cv::Rect(10, 10, 30, 20)).setTo(255);
  mask(cv::Rect(15, 15, 5, 5)).setTo(0);
  mask(cv::Rect(30, 15, 4, 4)).setTo(0);
  EXPECT_EQ(fillHole(mask, {17, 17}), cv::Rect(15, 15, 5, 5));
  EXPECT_EQ(cv::countNonZero(mask(cv::Rect(15, 15, 5, 5))), 25);
  EXPECT_EQ(cv::countNonZero(mask(cv::Rect(30, 15, 4, 4))), 0) << "another hole";
}

TEST(MaskTools, FillsNothing_WhenThePointLiesInNoHole) {
  cv::Mat mask = blank();
  mask(cv::Rect(10, 10, 30, 20)).setTo(255);
  mask(cv::Rect(10, 15, 8, 5)).setTo(0);  // a bay, open to the left
  const int before = cv::countNonZero(mask);
  EXPECT_TRUE(fillHole(mask, {12, 17}).empty());
  EXPECT_TRUE(fillHole(mask, {2, 2}).empty());
  EXPECT_TRUE(fillHole(mask, {25, 12}).empty()) << "painted";
  EXPECT_TRUE(fillHole(mask, {-5, 900}).empty());
  EXPECT_EQ(cv::countNonZero(mask), before);
}

}  // namespace
}  // namespace scantrove::test
