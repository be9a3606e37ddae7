#include "core/geometry/surface_step.h"

#include <gtest/gtest.h>

#include <numbers>

namespace scantrove {
namespace {

Eigen::Vector4f normalAt(float angle_rad) { return {std::sin(angle_rad), 0, -std::cos(angle_rad), 1}; }

TEST(DepthStep, IsLevel_UpToThreeCentimetres) {
  EXPECT_EQ(depthStep(1, 1.029F), DepthStep::level);
  EXPECT_EQ(depthStep(1, 1.031F), DepthStep::deeper);
  EXPECT_EQ(depthStep(1, 0.971F), DepthStep::level);
  EXPECT_EQ(depthStep(1, 0.969F), DepthStep::nearer);
}

TEST(DepthStep, GrowsWithDepth_BeyondOneAndAHalfMetres) {
  EXPECT_EQ(depthStep(3, 3.059F), DepthStep::level);
  EXPECT_EQ(depthStep(3, 3.061F), DepthStep::deeper);
  EXPECT_EQ(depthStep(3, 2.939F), DepthStep::nearer);
}

TEST(BendBetween, IsPositiveInAFold_NegativeOverARidge) {
  // In a fold the normals turn towards each other.
  const Eigen::Vector3f across(1, 0, 0);
  EXPECT_NEAR(bendBetween(normalAt(0.2F), normalAt(-0.2F), across), 0.4F, 1e-5F);
  EXPECT_NEAR(bendBetween(normalAt(-0.2F), normalAt(0.2F), across), -0.4F, 1e-5F);
  EXPECT_NEAR(bendBetween(normalAt(0.3F), normalAt(0.3F), across), 0, 1e-5F);
}

TEST(BendBetween, IsHalfATurn_WhenNormalsAreOpposite) {
  constexpr float kHalfTurn = std::numbers::pi_v<float>;
  EXPECT_NEAR(std::abs(bendBetween(normalAt(0), normalAt(kHalfTurn), {1, 0, 0})), kHalfTurn, 1e-3F);
}

}  // namespace
}  // namespace scantrove
