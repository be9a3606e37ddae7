#include "core/session/painted_view.h"

#include <gmock/gmock.h>

#include <opencv2/core.hpp>

namespace scantrove::test {
namespace {

using Area = PaintedSurface::Area;
using testing::ElementsAre;

constexpr int kWidth = 160, kHeight = 120;
constexpr RegionId kLeft{1}, kRight{2};

/// A wall at 1 m: region 1 on the left, region 2 on the right.
RenderedView wall() {
  RenderedView view;
  view.K = {200, 200, 79.5F, 59.5F, kWidth, kHeight};
  view.T_world_camera = Eigen::Isometry3d(Eigen::Translation3d(1, 2, 3));
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Eigen::Vector3f p =
          view.K.backProject(static_cast<float>(x), static_cast<float>(y), 1) + Eigen::Vector3f(1, 2, 3);
      view.vertices_world.emplace_back(p.x(), p.y(), p.z(), 1);
      view.regions.push_back(x < kWidth / 2 ? kLeft : kRight);
    }
  }
  return view;
}

/// Masks of twice the view's size.
MaskCorrection correction(const cv::Rect& added, const cv::Rect& removed = {}) {
  cv::Mat add = cv::Mat::zeros(2 * kHeight, 2 * kWidth, CV_8UC1), remove = add.clone();
  add(added).setTo(255);
  remove(removed).setTo(255);
  return correctionOf(add, remove);
}

/// The point of the wall at a pixel of the view, moved along the optical axis.
Eigen::Vector3f pointAt(float x, float y, float z = 1) {
  return wall().K.backProject(x, y, z) + Eigen::Vector3f(1, 2, 3);
}

TEST(PaintedView, TellsWhereAPointLies) {
  // 8 mm at 1 m are 1.6 pixels.
  const PaintedSurface surface =
      paintedSurface(wall(), {}, kLeft, correction({100, 100, 120, 60}, {20, 20, 40, 40}));
  EXPECT_EQ(surface.sight(pointAt(80, 65)).area, Area::added);
  EXPECT_EQ(surface.sight(pointAt(20, 20)).area, Area::removed);
  EXPECT_EQ(surface.sight(pointAt(130, 20)).area, Area::other);
  EXPECT_EQ(surface.sight(pointAt(50, 65)).area, Area::unclear) << "at the outline";
  EXPECT_EQ(surface.sight(pointAt(49, 65)).area, Area::unclear);
  EXPECT_EQ(surface.sight(pointAt(-20, 65)).area, Area::beyond);
  EXPECT_EQ(surface.sight(pointAt(80, 65, -1)).area, Area::beyond) << "behind the camera";
  EXPECT_TRUE(surface.sight(pointAt(80, 65)).is_visible);
  EXPECT_FALSE(surface.sight(pointAt(80, 65, 1.1F)).is_visible) << "hidden by the wall";
}

TEST(PaintedView, ListsRegionsBehindAddedPixels) {
  const PaintedSurface surface = paintedSurface(wall(), {}, kLeft, correction({100, 100, 120, 60}));
  ASSERT_EQ(surface.added_world.size(), 1U);
  EXPECT_TRUE(surface.added_world.contains(kRight));
  for (const Eigen::Vector3f& place : surface.added_world.at(kRight))
    EXPECT_EQ(surface.sight(place).area, Area::added);
  EXPECT_TRUE(surface.removed_world.empty());
}

TEST(PaintedView, ListsRegionsBesideRemovedPixels) {
  const PaintedSurface surface = paintedSurface(wall(), {}, kLeft, correction({}, {120, 40, 40, 80}));
  EXPECT_FALSE(surface.removed_world.empty());
  EXPECT_THAT(surface.around, ElementsAre(kRight));
  const PaintedSurface inside = paintedSurface(wall(), {}, kLeft, correction({}, {20, 40, 40, 80}));
  EXPECT_TRUE(inside.around.empty()) << "enclosed";
}

TEST(PaintedView, HidesSurface_WhereTheImageShowsSomethingInFront) {
  cv::Mat depth_m(2 * kHeight, 2 * kWidth, CV_32FC1, cv::Scalar::all(1));
  depth_m.colRange(0, kWidth).setTo(0.8);
  depth_m.rowRange(0, 20).setTo(0);
  const PaintedSurface surface = paintedSurface(wall(), depth_m, kLeft, correction({100, 100, 120, 60}));
  EXPECT_FALSE(surface.sight(pointAt(60, 65)).is_visible) << "a hand that is not in the map";
  EXPECT_TRUE(surface.sight(pointAt(90, 65)).is_visible);
  EXPECT_TRUE(surface.sight(pointAt(60, 5)).is_visible) << "no reading";
}

TEST(PaintedView, KeepsTheMiddleOfAThinMask) {
  const PaintedSurface surface = paintedSurface(wall(), {}, kLeft, correction({180, 60, 6, 120}));
  EXPECT_EQ(surface.sight(pointAt(91, 60)).area, Area::added);
  EXPECT_TRUE(surface.added_world.contains(kRight));
}

}  // namespace
}  // namespace scantrove::test
