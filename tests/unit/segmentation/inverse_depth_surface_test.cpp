#include "core/segmentation/inverse_depth_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace scantrove {
namespace {

using SurfaceSample = InverseDepthSurface::Sample;

/// A tilted plane in the camera's frame. Its normal faces the camera.
struct TiltedPlane {
  Eigen::Vector3d point{0, 0, 1.2};
  Eigen::Vector3d normal = Eigen::Vector3d(0.15, -0.55, -0.8).normalized();

  [[nodiscard]] static Eigen::Vector3d ray(double x, double y) { return {x, y, 1}; }
  /// Depth of the point on the ray that is `height_m` above the plane.
  [[nodiscard]] double depth(double x, double y, double height_m = 0) const {
    return (point.dot(normal) + height_m) / ray(x, y).dot(normal);
  }
  /// Distance of the point at that depth from the plane, > 0 towards the camera.
  [[nodiscard]] double height(double x, double y, double z_m) const {
    return normal.dot(z_m * ray(x, y) - point);
  }
};

/// Calls `visit(x, y)` with ray coordinates of a wide image.
void forRays(const auto& visit) {
  constexpr int kColumns = 40, kRows = 30;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      visit(-0.5 + static_cast<double>(column) / (kColumns - 1), -0.4 + 0.8 * row / (kRows - 1));
}

SurfaceSample sampleAt(double x, double y, double z_m) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z_m)};
}

/// Readings of the plane. Of ten, `outliers` lie 5 to 10 cm above it.
std::vector<SurfaceSample> readingsOf(const TiltedPlane& plane, unsigned outliers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> height_m(0.05, 0.1);
  std::vector<SurfaceSample> samples;
  forRays([&](double x, double y) {
    const bool is_outlier = random() % 10 < outliers;
    samples.push_back(sampleAt(x, y, plane.depth(x, y, is_outlier ? height_m(random) : 0)));
  });
  return samples;
}

constexpr float kTolerance_m = 0.02F;

TEST(InverseDepthSurface, FitIsThePlane_WhenThirtyPercentOfTheReadingsLieAboveIt) {
  const TiltedPlane plane;
  for (const bool bowed : {false, true}) {
    const auto surface = InverseDepthSurface::fit(readingsOf(plane, 3), kTolerance_m, bowed);
    ASSERT_TRUE(surface);
    EXPECT_LT((surface->normal().cast<double>() - plane.normal).norm(), 2e-3) << surface->normal();
    forRays([&](double x, double y) {
      const SurfaceSample top = sampleAt(x, y, plane.depth(x, y, 0.08));
      EXPECT_NEAR(surface->height(top.x, top.y, top.z_m), 0.08, 0.001) << x << ", " << y;
      EXPECT_NEAR(surface->inverseDepth(top.x, top.y), 1 / plane.depth(x, y), 0.001) << x << ", " << y;
    });
  }
}

TEST(InverseDepthSurface, HeightIsPositiveTowardsTheCamera) {
  const TiltedPlane plane;
  const auto surface = InverseDepthSurface::fit(readingsOf(plane, 0), kTolerance_m, false);
  ASSERT_TRUE(surface);
  EXPECT_LT(surface->normal().z(), 0);
  const auto z_on_plane = static_cast<float>(plane.depth(0.2, -0.1));
  EXPECT_GT(surface->height(0.2F, -0.1F, z_on_plane - 0.01F), 0.005F);
  EXPECT_LT(surface->height(0.2F, -0.1F, z_on_plane + 0.01F), -0.005F);
  for (const double step_m : {-0.3, -0.02, 0.0, 0.02, 0.3}) {
    const double z_m = plane.depth(0.2, -0.1) - step_m;
    EXPECT_NEAR(surface->height(0.2F, -0.1F, static_cast<float>(z_m)), plane.height(0.2, -0.1, z_m), 1e-4);
  }
}

TEST(InverseDepthSurface, DepthAtInvertsHeight) {
  const TiltedPlane plane;
  const auto surface = InverseDepthSurface::fit(readingsOf(plane, 0), kTolerance_m, false);
  ASSERT_TRUE(surface);
  for (const double height_m : {-0.05, 0.0, 0.03, 0.2}) {
    forRays([&](double x, double y) {
      const SurfaceSample ray = sampleAt(x, y, 1);
      const float z_m = surface->depthAt(ray.x, ray.y, static_cast<float>(height_m));
      EXPECT_NEAR(z_m, plane.depth(x, y, height_m), 1e-4) << x << ", " << y;
      EXPECT_NEAR(surface->height(ray.x, ray.y, z_m), height_m, 1e-5) << x << ", " << y;
    });
  }
}

TEST(InverseDepthSurface, DepthIsZero_WhereTheSurfaceIsBehindTheCamera) {
  InverseDepthSurface::Coefficients coefficients = InverseDepthSurface::Coefficients::Zero();
  coefficients[0] = 0.5;
  coefficients[1] = -1;
  const InverseDepthSurface surface(coefficients);
  EXPECT_FLOAT_EQ(surface.depthAt(0, 0, 0), 2);
  EXPECT_LT(surface.inverseDepth(1, 0), 0);
  EXPECT_EQ(surface.depthAt(1, 0, 0), 0);
}

TEST(InverseDepthSurface, FitFollowsAQuadraticTerm_OnlyIfBowed) {
  const TiltedPlane plane;
  constexpr double kBow = 0.05;  // 1/m
  std::vector<SurfaceSample> samples;
  forRays([&](double x, double y) {
    samples.push_back(sampleAt(x, y, 1 / (1 / plane.depth(x, y) + kBow * x * x)));
  });
  constexpr float kFlat_m = 0.009F;
  const auto bowed = InverseDepthSurface::fit(samples, kFlat_m, true);
  const auto flat = InverseDepthSurface::fit(samples, kFlat_m, false);
  ASSERT_TRUE(bowed);
  ASSERT_TRUE(flat);
  const auto farthest = [&samples](const InverseDepthSurface& surface) {
    float most_m = 0;
    for (const SurfaceSample& s : samples)
      most_m = std::max(most_m, std::abs(surface.height(s.x, s.y, s.z_m)));
    return most_m;
  };
  EXPECT_LT(farthest(*bowed), 0.0005F);
  EXPECT_GT(farthest(*flat), 0.003F);
}

TEST(InverseDepthSurface, FitIsNone_WithTooFewSamples) {
  const std::vector<SurfaceSample> samples = readingsOf(TiltedPlane(), 0);
  std::vector<SurfaceSample> few, enough;
  for (std::size_t i = 0; i < samples.size(); i += 60) few.push_back(samples[i]);  // not in one column
  for (std::size_t i = 0; i < samples.size(); i += 7) enough.push_back(samples[i]);
  ASSERT_EQ(few.size(), 20U);
  EXPECT_FALSE(InverseDepthSurface::fit(few, kTolerance_m, false));
  EXPECT_TRUE(InverseDepthSurface::fit(enough, kTolerance_m, false));
  EXPECT_FALSE(InverseDepthSurface::fit({}, kTolerance_m, false));
}

TEST(InverseDepthSurface, FitIsNone_WhenReadingsAreScattered) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> x(-0.5, 0.5), y(-0.4, 0.4), z_m(0.5, 5);
  std::vector<SurfaceSample> samples;
  for (int i = 0; i < 200; ++i) samples.push_back(sampleAt(x(random), y(random), z_m(random)));
  EXPECT_FALSE(InverseDepthSurface::fit(samples, 0.005F, false));
}

}  // namespace
}  // namespace scantrove
