// Pixels where a frame's readings contradict the map's surface.
#include "core/fusion/contradicted_surface.h"

#include <gtest/gtest.h>

#include <vector>

namespace scantrove::test {
namespace {

const Intrinsics kWorking{100, 100, 39.5F, 29.5F, 80, 60};
constexpr float kSurface_m = 1.5F, kDepthNoise_m = 0.0015F;
const cv::Rect kPatch(20, 10, 30, 20);  // working pixels

/// A wall that faces a camera, and the camera's readings at twice the resolution.
struct Wall {
  RenderedView view{kWorking,
                    Eigen::Isometry3d(Eigen::Translation3d(0.4, -1, 2) *
                                      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()))};
  cv::Mat readings_m{120, 160, CV_32FC1, cv::Scalar(kSurface_m)};

  Wall() {
    for (int v = 0; v < kWorking.height; ++v) {
      for (int u = 0; u < kWorking.width; ++u) {
        const Eigen::Vector3f p =
            kWorking.backProject(static_cast<float>(u), static_cast<float>(v), kSurface_m);
        view.vertices_world.emplace_back();
        view.vertices_world.back() << (view.T_world_camera * p.cast<double>()).cast<float>(), 1;
      }
    }
  }
  void read(float z_m) { readings_m(cv::Rect(2 * kPatch.tl(), 2 * kPatch.br())).setTo(z_m); }
  [[nodiscard]] cv::Mat contradicted() const {
    return contradictedSurface({kWorking.resizedTo(160, 120), view.T_world_camera, readings_m}, view,
                               kDepthNoise_m);
  }
};

/// Pixels of the patch without its border, where neighbouring readings agree with the wall.
int insideOfPatch() { return (kPatch.width - 2) * (kPatch.height - 2); }

TEST(ContradictedSurface, IsFound_WhenReadingsAreInFrontOrBehind) {
  for (const float z_m : {1.0F, 2.0F}) {
    Wall wall;
    wall.read(z_m);
    const cv::Mat contradicted = wall.contradicted();
    EXPECT_EQ(contradicted.size(), cv::Size(kWorking.width, kWorking.height));
    EXPECT_EQ(cv::countNonZero(contradicted), insideOfPatch()) << z_m;
    EXPECT_EQ(cv::countNonZero(contradicted(kPatch)), insideOfPatch()) << z_m;
  }
}

TEST(ContradictedSurface, IsEmpty_WithNoiseOrMissingReadings) {
  // The tolerance is six standard deviations of depth noise (20 mm at 1.5 m), plus 50 mm in front and 25 mm
  // behind.
  for (const float z_m : {kSurface_m - 0.065F, kSurface_m + 0.04F, 0.0F}) {
    Wall wall;
    wall.read(z_m);
    EXPECT_EQ(cv::countNonZero(wall.contradicted()), 0) << z_m;
  }
}

TEST(ContradictedSurface, IsEmpty_WhenANeighboringReadingAgrees) {
  Wall wall;
  wall.readings_m.setTo(2.0F);
  for (int v = 0; v < wall.readings_m.rows; v += 3) wall.readings_m.row(v).setTo(kSurface_m);
  EXPECT_EQ(cv::countNonZero(wall.contradicted()), 0);
}

TEST(ContradictedSurface, IsEmpty_WithoutSurface) {
  Wall wall;
  wall.read(1.0F);
  for (Eigen::Vector4f& vertex : wall.view.vertices_world) vertex.w() = 0;
  EXPECT_EQ(cv::countNonZero(wall.contradicted()), 0);
}

}  // namespace
}  // namespace scantrove::test
