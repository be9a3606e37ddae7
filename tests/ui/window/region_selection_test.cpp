#include <gtest/gtest.h>

#include <QSignalSpy>

#include "ui/models/region_selection.h"
#include "ui/panels/frame_pointing.h"
#include "ui/panels/region_picture.h"

namespace scantrove {
namespace {

ScanSnapshot snapshotWith(const std::vector<RegionChange>& changes, const RegionInfos& infos) {
  ScanSnapshot snapshot;
  snapshot.changed_regions = changes;
  snapshot.region_infos = std::make_shared<const RegionInfos>(infos);
  return snapshot;
}

RegionInfo info(std::uint32_t region, std::int64_t voxels, const std::string& name = {}) {
  RegionInfo region_info;
  region_info.region = RegionId{region};
  region_info.voxels = voxels;
  region_info.note.name = name;
  return region_info;
}

TEST(RegionSelection, SelectionFollowsAJoinedRegion) {
  RegionSelection selection;
  selection.update(snapshotWith({{FragmentId{1}, RegionId{10}}, {FragmentId{2}, RegionId{20}}},
                                {info(10, 500), info(20, 900)}));
  selection.select(RegionId{20});
  const QSignalSpy changes(&selection, &RegionSelection::selectionChanged);
  selection.update(snapshotWith({{FragmentId{2}, RegionId{10}}}, {info(10, 1400)}));
  EXPECT_EQ(selection.selected(), std::vector{RegionId{10}});
  EXPECT_EQ(changes.count(), 1);
}

TEST(RegionSelection, SelectionKeepsASplitRegion_AndDropsARemovedOne) {
  RegionSelection selection;
  selection.update(
      snapshotWith({{FragmentId{1}, RegionId{10}}, {FragmentId{2}, RegionId{10}}}, {info(10, 1000)}));
  selection.select(RegionId{10});
  selection.update(snapshotWith({{FragmentId{2}, RegionId{11}}}, {info(10, 600), info(11, 400)}));
  EXPECT_EQ(selection.selected(), std::vector{RegionId{10}});
  selection.update(snapshotWith({{FragmentId{1}, RegionId{}}}, {info(11, 400)}));
  EXPECT_TRUE(selection.selected().empty());
}

TEST(RegionSelection, WalksBySize_WithoutBackgroundAndSmallRegions) {
  RegionSelection selection;
  RegionInfo table = info(1, 90000);
  table.note.background = true;
  selection.update(snapshotWith({}, {table, info(2, 500), info(3, 5000), info(4, 3)}));
  selection.selectBySize(true);
  EXPECT_EQ(selection.selected(), std::vector{RegionId{3}});
  // Region 2 has grown beyond region 3, and is still the next.
  selection.update(snapshotWith({}, {table, info(2, 50000), info(3, 5000), info(4, 3)}));
  selection.selectBySize(true);
  EXPECT_EQ(selection.selected(), std::vector{RegionId{2}});
  selection.selectBySize(false);
  EXPECT_EQ(selection.selected(), std::vector{RegionId{3}});
  selection.selectBySize(true);
  selection.selectBySize(true);
  EXPECT_EQ(selection.selected(), std::vector{RegionId{2}}) << "the walk starts again";
}

TEST(RegionSelection, SelectWithAddTogglesARegion) {
  RegionSelection selection;
  selection.select(RegionId{3});
  selection.select(RegionId{5}, true);
  EXPECT_EQ(selection.selected(), (std::vector{RegionId{3}, RegionId{5}}));
  selection.select(RegionId{3}, true);
  EXPECT_EQ(selection.selected(), std::vector{RegionId{5}});
  selection.select(RegionId{});
  EXPECT_TRUE(selection.selected().empty());
}

TEST(RegionSelection, TitleIsTheName_OrTheNumber) {
  RegionSelection selection;
  selection.update(snapshotWith({}, {info(2, 500, "red cup"), info(3, 5000)}));
  EXPECT_EQ(selection.title(RegionId{2}), QStringLiteral("red cup"));
  EXPECT_EQ(selection.title(RegionId{3}), QStringLiteral("Region 3"));
}

ScanSnapshot twoHalves() {
  ScanSnapshot snapshot;
  snapshot.K = {50, 50, 31.5F, 23.5F, 64, 48};
  snapshot.pose.T_world_camera.translation() = Eigen::Vector3d(1, 2, 3);
  snapshot.regions = cv::Mat(48, 64, CV_32SC1, cv::Scalar(5));
  snapshot.regions.colRange(32, 64).setTo(7);
  snapshot.depth_fused_m = cv::Mat(48, 64, CV_32FC1, cv::Scalar(2));
  return snapshot;
}

TEST(FramePointing, ReturnsRegionAndPointOfAPosition) {
  FramePointing pointing;
  pointing.show(twoHalves());
  const RegionPoint left = pointing.at({0.25, 0.5}, FramePointing::Picture::other);
  EXPECT_EQ(left.region, RegionId{5});
  EXPECT_EQ(pointing.at({0.75, 0.5}, FramePointing::Picture::color).region, RegionId{7});
  // Pixel (16, 24) at 2 m: x = (16 - 31.5) * 2 / 50, y = (24 - 23.5) * 2 / 50, plus the camera's position.
  ASSERT_TRUE(left.point_world);
  EXPECT_TRUE(left.point_world->isApprox(Eigen::Vector3f(1 - 0.62F, 2 + 0.02F, 5), 1e-4F));
  pointing.clear();
  EXPECT_FALSE(pointing.at({0.25, 0.5}, FramePointing::Picture::other).region);
}

TEST(FramePointing, MapsColorPositions_WhenTheColorCameraIsApart) {
  ScanSnapshot snapshot = twoHalves();
  // In colour, everything lies a quarter of the width further right.
  snapshot.color_places = cv::Mat(48, 64, CV_32FC2);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      snapshot.color_places.at<cv::Vec2f>(y, x) = {(static_cast<float>(x) + 0.5F) / 64 + 0.25F,
                                                   (static_cast<float>(y) + 0.5F) / 48};
    }
  }
  FramePointing pointing;
  pointing.show(snapshot);
  EXPECT_EQ(pointing.at({0.6, 0.5}, FramePointing::Picture::other).region, RegionId{7});
  EXPECT_EQ(pointing.at({0.6, 0.5}, FramePointing::Picture::color).region, RegionId{5});
  EXPECT_EQ(pointing.at({0.9, 0.5}, FramePointing::Picture::color).region, RegionId{7});
  EXPECT_FALSE(pointing.at({0.1, 0.5}, FramePointing::Picture::color).region) << "no depth there";
}

TEST(RegionPicture, HighlightsHoveredAndSelectedRegionsOnly) {
  cv::Mat ids(20, 30, CV_32SC1, cv::Scalar(1));
  ids.colRange(10, 20).setTo(2);
  ids.colRange(20, 30).setTo(3);
  EXPECT_TRUE(highlightPicture(ids, {}, {}).isNull());
  EXPECT_TRUE(highlightPicture(ids, RegionId{9}, {}).isNull()) << "region 9 is not in view";
  const QImage lit = highlightPicture(ids, RegionId{1}, {RegionId{2}});
  EXPECT_EQ(qAlpha(lit.pixel(25, 10)), 0);
  EXPECT_GT(qAlpha(lit.pixel(5, 10)), 0);
  EXPECT_LT(qBlue(lit.pixel(15, 10)), 50) << "yellow";
  EXPECT_EQ(qAlpha(lit.pixel(10, 10)), 255) << "its edge";
}

TEST(RegionPicture, BandSelectsRegionsMostlyInsideIt) {
  cv::Mat ids(20, 30, CV_32SC1, cv::Scalar(0));
  ids(cv::Rect(2, 2, 6, 6)).setTo(4);
  ids(cv::Rect(12, 2, 16, 6)).setTo(5);
  EXPECT_EQ(regionsIn(ids, cv::Rect(0, 0, 16, 20)), std::vector{RegionId{4}});
  EXPECT_EQ(regionsIn(ids, cv::Rect(0, 0, 30, 20)), (std::vector{RegionId{4}, RegionId{5}}));
}

}  // namespace
}  // namespace scantrove
