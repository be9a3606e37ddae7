#include "core/capture/lens_distortion.h"

#include <gtest/gtest.h>

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

TEST(Undistorter, ChangesNothing_WhenTheCameraIsAPinhole) {
  cv::Mat depth(480, 640, CV_16UC1);
  cv::randu(depth, 0, 60000);
  EXPECT_EQ(cv::norm(Undistorter({}, kCamera).ofDepth(depth), depth, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace scantrove
