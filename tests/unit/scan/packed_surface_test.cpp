#include "core/scan/packed_surface.h"

#include <gtest/gtest.h>

#include <random>

#include "core/scan/scan_snapshot.h"

namespace scantrove {
namespace {

TEST(PackedColor, KeepsAllBytesAndDistinguishesBlackFromUnknown) {
  EXPECT_EQ(PackedColor::of(1, 2, 255).rgb, (std::array<std::uint8_t, 3>{1, 2, 255}));
  EXPECT_FALSE(PackedColor().known());
  EXPECT_TRUE(PackedColor::of(0, 0, 0).known());
  EXPECT_LE(PackedColor::of(0, 0, 0).rgb[0], 1);
}

TEST(PackedNormal, KeepsTheDirection_WithinTwoDegrees) {
  std::mt19937 random(11);
  std::normal_distribution<float> any;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3f normal(any(random), any(random), any(random));
    const Eigen::Vector3f unpacked = PackedNormal::of(normal).unpacked();
    EXPECT_NEAR(unpacked.norm(), 1, 1e-5);
    EXPECT_GT(unpacked.dot(normal.normalized()), 0.9996F) << normal.transpose();
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0F, 1.0F}) {
      const Eigen::Vector3f normal = sign * Eigen::Vector3f::Unit(axis);
      EXPECT_GT(PackedNormal::of(normal).unpacked().dot(normal), 0.9996F) << normal.transpose();
    }
  }
}

TEST(PackedNormal, StaysUnknown_WhenZero) {
  EXPECT_FALSE(PackedNormal::of(Eigen::Vector3f::Zero()).known());
  EXPECT_EQ(PackedNormal().unpacked(), Eigen::Vector3f(Eigen::Vector3f::Zero()));
  EXPECT_TRUE(PackedNormal::of(Eigen::Vector3f::UnitZ()).known());
}

TEST(CloudPoint, IsSmallAndGivesItsSurfacePoint) {
  EXPECT_LE(sizeof(CloudBrick::Point), 24U);
  CloudBrick::Point point{1, 2, 3, FragmentId{4}};
  EXPECT_EQ(point.onSurface(0.006F), point.center()) << "without a normal, the voxel centre";
  point.normal = PackedNormal::of(Eigen::Vector3f::UnitX());
  point.height = 50;
  EXPECT_NEAR(point.onSurface(0.006F).x(), 0.997F, 1e-4);
}

}  // namespace
}  // namespace scantrove
