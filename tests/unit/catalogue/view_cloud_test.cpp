#include "core/catalogue/view_cloud.h"

#include <gtest/gtest.h>

#include <map>
#include <opencv2/core.hpp>

namespace scantrove {
namespace {

constexpr std::int64_t kSession = 4;
constexpr float kDepth_m = 0.8F;
const Intrinsics kCamera{300, 300, 159.5F, 119.5F, 320, 240};

/// A plane square to the camera that fills a box of the image; the crop is `scale` times as fine.
ObjectView planeView(int scale, const Eigen::Vector3d& camera = Eigen::Vector3d::Zero()) {
  ObjectView view;
  view.session = kSession;
  view.frame_px = {320, 240};
  view.box_px = {100, 80, 60, 40};
  const cv::Size size(60 * scale, 40 * scale);
  view.color = cv::Mat(size, CV_8UC3, cv::Scalar(10, 20, 30));
  view.mask = cv::Mat(size, CV_8UC1, cv::Scalar(255));
  view.depth_mm = cv::Mat(size, CV_16UC1, cv::Scalar(kDepth_m * 1000));
  view.T_world_camera = Eigen::Isometry3d(Eigen::Translation3d(camera));
  return view;
}

Eigen::AlignedBox3f boxOf(const ViewCloud& cloud) {
  Eigen::AlignedBox3f box;
  for (const ViewPoint& point : cloud.points) box.extend(point.position);
  return box;
}

TEST(ViewCloud, LiesWhereTheCameraSawIt_AtAnyResolution) {
  for (const int scale : {1, 2}) {
    const std::vector<ObjectView> views{planeView(scale, {0.1, 0, 0})};
    const ViewCloud cloud = cloudOfViews(views, {{kSession, kCamera}});
    EXPECT_EQ(cloud.session, kSession);
    EXPECT_EQ(cloud.views, 1);
    const Eigen::AlignedBox3f box = boxOf(cloud);
    ASSERT_FALSE(box.isEmpty());
    // Columns 100 .. 159, but those at the edge of the mask have no neighbours: u - cx over fx times depth.
    const float pixel_m = kDepth_m / 300;
    EXPECT_NEAR(box.min().x(), 0.1F + (101 - 159.5F) * pixel_m, pixel_m);
    EXPECT_NEAR(box.max().x(), 0.1F + (158 - 159.5F) * pixel_m, pixel_m);
    EXPECT_NEAR(box.min().y(), (81 - 119.5F) * pixel_m, pixel_m);
    EXPECT_NEAR(box.max().z(), kDepth_m, 1e-4);
    EXPECT_NEAR(cloud.points[0].normal.z(), -1, 1e-3) << "towards the camera";
    EXPECT_EQ(cloud.points[0].rgb, (std::array<std::uint8_t, 3>{30, 20, 10}));
  }
}

TEST(ViewCloud, HasOnePointForOverlappingViews) {
  const ViewCloud one = cloudOfViews(std::vector{planeView(1)}, {{kSession, kCamera}});
  const ViewCloud two = cloudOfViews(std::vector{planeView(1), planeView(1)}, {{kSession, kCamera}});
  EXPECT_EQ(two.views, 2);
  EXPECT_EQ(one.points.size(), two.points.size());
}

TEST(ViewCloud, LeavesOutPixelsBesideAStepInDepth) {
  ObjectView view = planeView(1);
  view.depth_mm.col(30).setTo(2 * kDepth_m * 1000);
  const ViewCloud cloud = cloudOfViews(std::vector{view}, {{kSession, kCamera}});
  EXPECT_NEAR(boxOf(cloud).max().z(), kDepth_m, 1e-4);
}

TEST(ViewCloud, IsOfTheSessionWithMostViews) {
  ObjectView other = planeView(1, {5, 0, 0});
  other.session = kSession + 1;
  const std::vector<ObjectView> views{planeView(1), other, planeView(1)};
  const ViewCloud cloud = cloudOfViews(views, {{kSession, kCamera}, {kSession + 1, kCamera}});
  EXPECT_EQ(cloud.session, kSession);
  EXPECT_LT(boxOf(cloud).max().x(), 1);
  EXPECT_EQ(cloudOfViews(views, {{kSession + 1, kCamera}}).session, kSession + 1)
      << "the camera must be known";
}

TEST(ViewCloud, IsEmptyWithoutWhatItNeeds) {
  const std::map<std::int64_t, Intrinsics> cameras{{kSession, kCamera}};
  ObjectView view = planeView(1);
  view.frame_px = {};
  EXPECT_TRUE(cloudOfViews(std::vector{view}, cameras).points.empty()) << "stored by an older version";
  view = planeView(1);
  view.depth_mm = cv::Mat();
  EXPECT_TRUE(cloudOfViews(std::vector{view}, cameras).points.empty());
  view = planeView(1);
  view.mask.setTo(0);
  EXPECT_TRUE(cloudOfViews(std::vector{view}, cameras).points.empty());
  EXPECT_TRUE(cloudOfViews({}, cameras).points.empty());
}

}  // namespace
}  // namespace scantrove
