#include "core/capture/lens_distortion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scantrove {
namespace {

const Intrinsics kCamera{517.3F, 516.5F, 318.6F, 255.3F, 640, 480};
const LensDistortion kLens{0.2624, -0.9531, -0.0054, 0.0026, 1.1633};

/// Position in the distorted image of a pinhole pixel (Brown's equations).
cv::Point2d bent(double u, double v) {
  const double x = (u - double{kCamera.cx}) / double{kCamera.fx};
  const double y = (v - double{kCamera.cy}) / double{kCamera.fy};
  const double r2 = x * x + y * y;
  const double radial = 1 + kLens.k1 * r2 + kLens.k2 * r2 * r2 + kLens.k3 * r2 * r2 * r2;
  const double bent_x = x * radial + 2 * kLens.p1 * x * y + kLens.p2 * (r2 + 2 * x * x);
  const double bent_y = y * radial + kLens.p1 * (r2 + 2 * y * y) + 2 * kLens.p2 * x * y;
  return {double{kCamera.fx} * bent_x + double{kCamera.cx}, double{kCamera.fy} * bent_y + double{kCamera.cy}};
}

TEST(Undistorter, FollowsBrownsEquations) {
  // An image whose values are their own column and row.
  cv::Mat columns(480, 640, CV_32FC1), rows(480, 640, CV_32FC1);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      columns.at<float>(v, u) = static_cast<float>(u);
      rows.at<float>(v, u) = static_cast<float>(v);
    }
  }
  const Undistorter undistorter(kLens, kCamera);
  const cv::Mat from_column = undistorter.ofColor(columns);
  const cv::Mat from_row = undistorter.ofColor(rows);
  for (const auto& [u, v] : {std::pair(319, 255), {100, 100}, {560, 80}, {40, 400}, {600, 440}}) {
    const cv::Point2d at = bent(u, v);
    EXPECT_NEAR(double{from_column.at<float>(v, u)}, at.x, 0.05)
        << u << ' ' << v;  // 1/32 pixel in the tables
    EXPECT_NEAR(double{from_row.at<float>(v, u)}, at.y, 0.05) << u << ' ' << v;
  }
}

/// Column of each pixel, as its value.
cv::Mat columnNumbers() {
  cv::Mat columns(480, 640, CV_32FC1);
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) columns.at<float>(v, u) = static_cast<float>(u);
  return columns;
}

TEST(Undistorter, FollowsTheRationalModel) {
  // Depth of an Azure Kinect.
  const LensDistortion lens{0.5479, -0.0210, 2.06e-5, -7.21e-5, -0.00265, 0.8897, 0.0861, -0.0139};
  const cv::Mat from = Undistorter(lens, kCamera).ofColor(columnNumbers());
  for (const auto& [u, v] : {std::pair(319, 255), {100, 100}, {560, 80}, {600, 440}}) {
    const double x = (u - double{kCamera.cx}) / double{kCamera.fx};
    const double y = (v - double{kCamera.cy}) / double{kCamera.fy};
    const double r2 = x * x + y * y, r4 = r2 * r2, r6 = r4 * r2;
    const double radial =
        (1 + lens.k1 * r2 + lens.k2 * r4 + lens.k3 * r6) / (1 + lens.k4 * r2 + lens.k5 * r4 + lens.k6 * r6);
    const double bent_x = x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x);
    EXPECT_NEAR(double{from.at<float>(v, u)}, double{kCamera.fx} * bent_x + double{kCamera.cx}, 0.05);
  }
}

TEST(Undistorter, InvertsTheFormula_WhenTheLensIsInverse) {
  LensDistortion lens{-0.056, 0.066, 0.001, -0.0005, -0.02};  // colour of a D455
  lens.is_inverse = true;
  const cv::Mat from = Undistorter(lens, kCamera).ofColor(columnNumbers());
  for (const auto& [u, v] : {std::pair(319, 255), {150, 120}, {520, 80}, {560, 400}}) {
    // The formula takes the distorted column and row, found for this pixel, back to the pixel.
    cv::Mat rows(480, 640, CV_32FC1);
    for (int row = 0; row < 480; ++row) rows.row(row).setTo(row);
    const cv::Mat from_rows = Undistorter(lens, kCamera).ofColor(rows);
    const double x = (double{from.at<float>(v, u)} - double{kCamera.cx}) / double{kCamera.fx};
    const double y = (double{from_rows.at<float>(v, u)} - double{kCamera.cy}) / double{kCamera.fy};
    const double r2 = x * x + y * y;
    const double radial = 1 + lens.k1 * r2 + lens.k2 * r2 * r2 + lens.k3 * r2 * r2 * r2;
    const double straight_x = x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x);
    EXPECT_NEAR(double{kCamera.fx} * straight_x + double{kCamera.cx}, u, 0.1);
  }
}

TEST(Undistorter, KeepsDepthsUnmixed) {
  cv::Mat depth(480, 640, CV_16UC1, cv::Scalar(800));
  depth.colRange(300, 640) = 3000;
  depth.rowRange(200, 220) = 0;
  const cv::Mat straight = Undistorter(kLens, kCamera).ofDepth(depth);
  ASSERT_EQ(straight.type(), CV_16UC1);
  for (int i = 0; i < 640 * 480; ++i) {
    const std::uint16_t value = straight.ptr<std::uint16_t>()[i];
    ASSERT_TRUE(value == 0 || value == 800 || value == 3000) << value;
  }
}

TEST(Undistorter, TakesDepthsFromTheNearestPixel) {
  cv::Mat columns(480, 640, CV_16UC1);
  for (int u = 0; u < 640; ++u) columns.col(u) = u + 1;
  const cv::Mat straight = Undistorter(kLens, kCamera).ofDepth(columns);
  for (int v = 60; v < 420; v += 7) {
    for (int u = 80; u < 560; u += 7) {
      const double column = straight.at<std::uint16_t>(v, u) - 1.0;
      EXPECT_LE(std::abs(column - bent(u, v).x), 0.51) << u << ' ' << v;
    }
  }
}

TEST(Undistorter, ChangesNothing_WhenTheCameraIsAPinhole) {
  cv::Mat depth(480, 640, CV_16UC1);
  cv::randu(depth, 0, 60000);
  EXPECT_EQ(cv::norm(Undistorter({}, kCamera).ofDepth(depth), depth, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace scantrove
