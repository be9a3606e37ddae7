#include "core/synthetic/footprint.h"

#include <gtest/gtest.h>

#include <cmath>

namespace scantrove::synthetic {
namespace {

Footprint rectangle(double x, double y, double half_x, double half_y, double yaw_deg = 0) {
  return {{x, y}, {half_x, half_y}, yaw_deg, 0};
}

Footprint disc(double x, double y, double radius) { return {{x, y}, {0, 0}, 0, radius}; }

TEST(Footprint, MeasuresDistancesOfRectanglesAndDiscs) {
  EXPECT_NEAR(distance(rectangle(0, 0, 1, 1), rectangle(3, 0, 1, 1)), 1, 1e-12);
  EXPECT_NEAR(distance(rectangle(0, 0, 1, 1), rectangle(5, 6, 1, 1)), std::hypot(3, 4), 1e-12);
  EXPECT_NEAR(distance(disc(0, 0, 0.5), disc(3, 4, 0.5)), 4, 1e-12);
  EXPECT_NEAR(distance(rectangle(0, 0, 1, 1), disc(0, 2, 0.25)), 0.75, 1e-12);
  // A square rotated by 45 degrees: its corner is sqrt(2) from its centre.
  EXPECT_NEAR(distance(rectangle(0, 0, 1, 1), rectangle(4, 0, 1, 1, 45)), 3 - std::sqrt(2), 1e-12);
  // Side to corner, not corner to corner.
  EXPECT_NEAR(distance(rectangle(0, 0, 1, 1, 45), rectangle(2, 2, 1, 1)), std::sqrt(2) - 1, 1e-12);
  EXPECT_LT(distance(rectangle(0, 0, 1, 1), rectangle(1.5, 0, 1, 1)), 0);
  EXPECT_LT(distance(disc(0, 0, 1), disc(1.5, 0, 1)), 0);
  EXPECT_LT(distance(rectangle(0, 0, 1, 0.1), rectangle(0, 0, 0.1, 1)), 0)
      << "a cross without a corner inside the other";
}

TEST(Footprint, ContainsAnother_WhenItLiesInside) {
  const Footprint table = rectangle(1, 1, 1, 0.5, 90);  // turned: 0.5 along x, 1 along y
  EXPECT_TRUE(contains(table, rectangle(1, 1.5, 0.4, 0.4)));
  EXPECT_FALSE(contains(table, rectangle(1.5, 1, 0.4, 0.4)));
  EXPECT_TRUE(contains(table, disc(1, 1.7, 0.29)));
  EXPECT_FALSE(contains(table, disc(1, 1.7, 0.31)));
}

TEST(Footprint, MovesAndTurns_WhenPlaced) {
  const Footprint placed = Footprint{{1, 0}, {0.2, 0.1}, 10, 0}.placedAt(5, 5, 90);
  EXPECT_NEAR(placed.center.x(), 5, 1e-12);
  EXPECT_NEAR(placed.center.y(), 6, 1e-12);
  EXPECT_NEAR(placed.yaw_deg, 100, 1e-12);
}

TEST(Volume, OverlapsNothing_WhenOnlyTouching) {
  const Volume lower{rectangle(0, 0, 1, 1), 0, 0.5};
  EXPECT_FALSE(lower.overlapsInHeight({rectangle(0, 0, 1, 1), 0.5, 1}));
  EXPECT_TRUE(lower.overlapsInHeight({rectangle(0, 0, 1, 1), 0.49, 1}));
  EXPECT_EQ(distance(Eigen::Vector3d(0.5, 0.5, 0.2), lower), 0);
  EXPECT_NEAR(distance(Eigen::Vector3d(4, 0, 4.5), lower), 5, 1e-12);
}

}  // namespace
}  // namespace scantrove::synthetic
