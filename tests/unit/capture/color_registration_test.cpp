#include "core/capture/color_registration.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace scantrove {
namespace {

constexpr ColorCamera kKinectColorCamera{525.0F, 525.0F, 320.0F, 240.0F, -0.025F};

// A point at the median depth lands where the depth camera sees it.
TEST(ColorRegistration, BringsThePlaneAtTheMedianDepthToTheDepthCamera) {
  const Intrinsics K{585, 585, 320, 240, 640, 480};
  const float z = 1.25F;
  const cv::Mat depth(480, 640, CV_16UC1, cv::Scalar(1250));
  for (const auto& [x, y] : {std::pair{0.0F, 0.0F}, {0.4F, -0.2F}, {-0.3F, 0.35F}}) {
    const cv::Point2f in_color(525 * (x - 0.025F) / z + 320, 525 * y / z + 240);
    const cv::Point2f in_depth(585 * x / z + 320, 585 * y / z + 240);
    cv::Mat color(480, 640, CV_8UC3, cv::Scalar::all(0));
    cv::circle(color, in_color, 4, cv::Scalar::all(255), cv::FILLED, cv::LINE_AA);
    cv::Mat seen;
    cv::cvtColor(registerColor(color, kKinectColorCamera, depth, 0.001F, K), seen, cv::COLOR_BGR2GRAY);
    const cv::Moments moments = cv::moments(seen);
    ASSERT_GT(moments.m00, 0);
    EXPECT_NEAR(moments.m10 / moments.m00, in_depth.x, 1.0);  // the disc is drawn to the pixel
    EXPECT_NEAR(moments.m01 / moments.m00, in_depth.y, 1.0);
  }
}

TEST(ColorRegistration, WithoutAnyDepthThereIsNoParallax) {
  const Intrinsics K{525, 525, 320, 240, 640, 480};
  cv::Mat color(480, 640, CV_8UC3);
  cv::randu(color, 0, 255);
  const cv::Mat registered =
      registerColor(color, kKinectColorCamera, cv::Mat(480, 640, CV_16UC1, cv::Scalar(0)), 0.001F, K);
  EXPECT_EQ(cv::norm(registered, color, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace scantrove
