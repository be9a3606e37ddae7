#include "core/scan/candidate_crop.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

const Intrinsics kWorking{290, 290, 159.5F, 119.5F, 320, 240};

/// Every pixel says where it is.
RgbdFrame frameOf(const cv::Size& color, const cv::Size& depth) {
  RgbdFrame frame;
  frame.index = 42;
  frame.metres_per_unit = 0.0002F;
  frame.color.create(color, CV_8UC3);
  for (int y = 0; y < color.height; ++y) {
    for (int x = 0; x < color.width; ++x) {
      frame.color.at<cv::Vec3b>(y, x) = {static_cast<uchar>(x % 256), static_cast<uchar>(y % 256),
                                         static_cast<uchar>(x / 256)};
    }
  }
  frame.depth.create(depth, CV_16UC1);
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      frame.depth.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(5 * (100 + x + y));
    }
  }
  return frame;
}

Candidate candidateAt(const cv::Rect& box) {
  Candidate candidate;
  candidate.box_px = box;
  candidate.mask = cv::Mat(box.size(), CV_8UC1, cv::Scalar(0));
  candidate.mask(cv::Rect(0, 0, (box.width + 1) / 2, box.height)) = 255;
  candidate.centroid_world = {1, 2, 3};
  candidate.size_m = {0.3F, 0.2F, 0.1F};
  return candidate;
}

TEST(CutView, TakesTheBoxOutOfTheFullResolution) {
  const ObjectView view = cutView(frameOf({640, 480}, {640, 480}), Eigen::Isometry3d::Identity(), kWorking,
                                  candidateAt({10, 20, 30, 40}));
  ASSERT_EQ(view.color.size(), cv::Size(60, 80));
  EXPECT_EQ(view.color.at<cv::Vec3b>(0, 0), cv::Vec3b(20, 40, 0));
  EXPECT_EQ(view.color.at<cv::Vec3b>(79, 59), cv::Vec3b(79, 119, 0));
  ASSERT_EQ(view.mask.size(), view.color.size());
  EXPECT_EQ(view.mask.at<uchar>(79, 29), 255);
  EXPECT_EQ(view.mask.at<uchar>(0, 30), 0);
  ASSERT_EQ(view.depth_mm.size(), view.color.size());
  ASSERT_EQ(view.depth_mm.type(), CV_16UC1);
  EXPECT_EQ(view.depth_mm.at<std::uint16_t>(0, 0), 100 + 20 + 40);  // millimetres
  EXPECT_EQ(view.frame_index, 42);
  EXPECT_EQ(view.box_px, cv::Rect(20, 40, 60, 80));
  EXPECT_EQ(view.frame_px, cv::Size(640, 480));
}

TEST(CutView, FollowsColourAndDepthOfTheirOwnResolutions) {
  const ObjectView view = cutView(frameOf({500, 300}, {320, 240}), Eigen::Isometry3d::Identity(), kWorking,
                                  candidateAt({7, 9, 11, 13}));
  // 7 * 500 / 320 = 10.9 .. 18 * 500 / 320 = 28.1, and 9 * 300 / 240 = 11.25 .. 27.5, rounded outwards.
  ASSERT_EQ(view.color.size(), cv::Size(29 - 10, 28 - 11));
  EXPECT_EQ(view.color.at<cv::Vec3b>(0, 0), cv::Vec3b(10, 11, 0));
  EXPECT_EQ(view.mask.size(), view.color.size());
  ASSERT_EQ(view.depth_mm.size(), view.color.size());
  EXPECT_EQ(view.depth_mm.at<std::uint16_t>(0, 0), 100 + 7 + 9);
  EXPECT_EQ(view.box_px, cv::Rect(7, 9, 11, 13)) << "of the depth image";
  EXPECT_EQ(view.frame_px, cv::Size(320, 240));
}

TEST(CutView, ABoxAtTheBorderStaysInTheImage) {
  const ObjectView view = cutView(frameOf({641, 479}, {641, 479}), Eigen::Isometry3d::Identity(), kWorking,
                                  candidateAt({300, 220, 20, 20}));
  EXPECT_EQ(view.color.cols, 641 - 600);
  EXPECT_EQ(view.color.rows, 479 - 439);
  EXPECT_EQ(view.mask.size(), view.color.size());
  EXPECT_EQ(view.depth_mm.size(), view.color.size());
}

TEST(CutView, LooksFromTheObjectToTheCamera) {
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  T_world_camera.translation() = Eigen::Vector3d(1, 2, 1);
  const ObjectView view =
      cutView(frameOf({64, 48}, {64, 48}), T_world_camera, kWorking, candidateAt({0, 0, 20, 20}));
  EXPECT_TRUE(view.direction.isApprox(Eigen::Vector3f(0, 0, -1)));
  EXPECT_TRUE(view.T_world_camera.isApprox(T_world_camera));
  EXPECT_EQ(view.size_m, Eigen::Vector3f(0.3F, 0.2F, 0.1F));
}

}  // namespace
}  // namespace scantrove
