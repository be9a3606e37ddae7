#include "core/labeling/observation_recorder.h"

#include <gtest/gtest.h>

namespace scantrove {
namespace {

/// Two surfaces side by side and a fragment of two pixels.
struct TwoSurfaces {
  static constexpr int kWidth = 80, kHeight = 60;
  RegionTable table;
  FragmentId left = table.newFragment(), right = table.newFragment(), tiny = table.newFragment();
  RenderedView view;

  TwoSurfaces() {
    view.K.width = kWidth;
    view.K.height = kHeight;
    view.fragments.resize(kWidth * kHeight);
    view.vertices_world.resize(kWidth * kHeight);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const auto at = static_cast<std::size_t>(y * kWidth + x);
        const bool is_left = x < kWidth / 2;
        view.fragments[at] = is_left ? left : right;
        view.vertices_world[at] = {is_left ? -1.0F : 1.0F, 0, 2, 1};
      }
    }
    view.fragments[0] = view.fragments[1] = tiny;
  }
  void record(const Eigen::Vector3d& camera) {
    view.T_world_camera = Eigen::Translation3d(camera);
    ObservationRecorder().record(view, table);
  }
};

TEST(ObservationRecorder, RecordsDirectionsFromTheSurfaceToTheCamera) {
  TwoSurfaces scene;
  scene.record({0, 0, 0});
  EXPECT_TRUE(scene.table.seenFrom(scene.left).covers({1, 0, -2}));
  EXPECT_TRUE(scene.table.seenFrom(scene.right).covers({-1, 0, -2}));
  EXPECT_FALSE(scene.table.seenFrom(scene.left).covers({-1, 0, 0}));
}

TEST(ObservationRecorder, AddsDirectionsOfAllFrames) {
  TwoSurfaces scene;
  scene.record({0, 0, 0});
  scene.record({4, 0, 2});
  EXPECT_TRUE(scene.table.seenFrom(scene.left).covers({1, 0, -2}));
  EXPECT_TRUE(scene.table.seenFrom(scene.left).covers({1, 0, 0}));
}

TEST(ObservationRecorder, IgnoresAFragment_WhenItHasFewPixels) {
  TwoSurfaces scene;
  scene.record({0, 0, 0});
  EXPECT_EQ(scene.table.seenFrom(scene.tiny), ViewCoverage());
}

TEST(ObservationRecorder, IgnoresPixelsWithoutSurface) {
  TwoSurfaces scene;
  for (auto& vertex : scene.view.vertices_world) vertex.w() = 0;
  scene.record({0, 0, 0});
  EXPECT_EQ(scene.table.seenFrom(scene.left), ViewCoverage());
}

TEST(RegionTable, CoverageSpansAllFragmentsAndIsEmpty_ForAReusedNumber) {
  RegionTable table;
  const FragmentId a = table.newFragment();
  const FragmentId b = table.newFragment();
  table.addViewDirection(a, {1, 0, 0});
  table.addViewDirection(b, {0, 0, 1});
  ASSERT_TRUE(table.join(table.regionOf(a), table.regionOf(b)));
  const ViewCoverage both = table.seenFrom(table.regionOf(a));
  EXPECT_TRUE(both.covers({1, 0, 0}));
  EXPECT_TRUE(both.covers({0, 0, 1}));
  const FragmentId cut = table.newFragmentBeside(a);
  EXPECT_EQ(table.seenFrom(cut), table.seenFrom(a));
  table.free(b);
  ASSERT_EQ(table.newFragment(), b);
  EXPECT_EQ(table.seenFrom(b), ViewCoverage());
  EXPECT_FALSE(table.seenFrom(table.regionOf(a)).covers({0, 0, 1}));
}

}  // namespace
}  // namespace scantrove
