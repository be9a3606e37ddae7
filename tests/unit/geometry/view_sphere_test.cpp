#include "core/geometry/view_sphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scantrove {
namespace {

Eigen::Vector3f at(float degrees) {
  const float a = degrees * std::numbers::pi_v<float> / 180.0F;
  return {std::cos(a), std::sin(a), 0};
}

TEST(ViewSphere, DirectionIsNew_WhenFarFromAllStoredOnes) {
  ViewSphere sphere;
  EXPECT_TRUE(sphere.isNew(at(0), 20));
  sphere.keep(2 * at(0));
  EXPECT_FALSE(sphere.isNew(at(19), 20));
  EXPECT_FALSE(sphere.isNew(3 * at(-19), 20));
  EXPECT_TRUE(sphere.isNew(at(19), 18));
  EXPECT_TRUE(sphere.isNew(at(21), 20));
  sphere.keep(at(21));
  EXPECT_FALSE(sphere.isNew(at(30), 20));
  EXPECT_TRUE(sphere.isNew(at(180), 20));
}

TEST(ViewSphere, DirectionIsNotNew_WhenZeroOrNotFinite) {
  EXPECT_FALSE(ViewSphere().isNew(Eigen::Vector3f::Zero(), 20));
  EXPECT_FALSE(ViewSphere().isNew(Eigen::Vector3f(NAN, 0, 1), 20));
}

}  // namespace
}  // namespace scantrove
