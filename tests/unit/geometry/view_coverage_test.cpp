#include "core/geometry/view_coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace scantrove {
namespace {

using Eigen::Vector3f;
constexpr float kPi = std::numbers::pi_v<float>;

Vector3f around(float azimuth_deg, float elevation_deg) {
  const float a = azimuth_deg * kPi / 180;
  const float e = elevation_deg * kPi / 180;
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

const SideAxes kZUp = SideAxes::of(Vector3f::UnitZ(), Vector3f::UnitX());

// A cap of 22.5 degrees is (1 - cos 22.5 deg) / 2 = 3.8 % of the sphere, that is 9.7 of 256 cells. The
// alignment with the lattice adds or removes a few.
TEST(ViewCoverage, OneViewCoversItsDirectionAndItsSurroundings) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  double shares = 0;
  constexpr int kObservations = 500;
  for (int i = 0; i < kObservations; ++i) {
    const Vector3f direction(normal(random), normal(random), normal(random));
    ViewCoverage coverage;
    coverage.addDirection(direction);
    EXPECT_TRUE(coverage.covers(direction)) << direction.transpose();
    EXPECT_FALSE(coverage.covers(-direction)) << direction.transpose();
    EXPECT_GE(coverage.share(), 6.0F / ViewCoverage::kCells);
    EXPECT_LE(coverage.share(), 14.0F / ViewCoverage::kCells);
    shares += static_cast<double>(coverage.share());
  }
  EXPECT_NEAR(shares / kObservations, 0.038, 0.004);
}

TEST(ViewCoverage, IsComplete_WhenSeenFromEverywhere) {
  ViewCoverage coverage;
  for (int e = -90; e <= 90; e += 15) {
    for (int a = 0; a < 360; a += 15)
      coverage.addDirection(around(static_cast<float>(a), static_cast<float>(e)));
  }
  EXPECT_EQ(coverage.share(), 1);
}

TEST(ViewCoverage, IgnoresADirection_WhenZeroOrNotFinite) {
  ViewCoverage coverage;
  coverage.addDirection(Vector3f::Zero());
  coverage.addDirection({std::numeric_limits<float>::quiet_NaN(), 0, 1});
  coverage.addDirection({std::numeric_limits<float>::infinity(), 0, 1});
  EXPECT_EQ(coverage, ViewCoverage());
}

TEST(SeenSides, AreComplete_AfterAFullCircleAtAnyHeight) {
  for (const float elevation_deg : {0.0F, 20.0F, 35.0F, 50.0F}) {
    ViewCoverage coverage;
    for (int a = 0; a < 360; a += 10) coverage.addDirection(around(static_cast<float>(a), elevation_deg));
    EXPECT_TRUE(sidesOf(coverage, kZUp).isComplete()) << elevation_deg;
  }
}

TEST(SeenSides, AreAboutHalf_AfterHalfACircle) {
  ViewCoverage coverage;
  for (int a = 0; a <= 180; a += 5) coverage.addDirection(around(static_cast<float>(a), 30));
  const SeenSides seen = sidesOf(coverage, kZUp);
  // The path passes sides 0 .. 6. A view covers 22.5 degrees, so one more side at either end may count.
  for (std::size_t side = 0; side <= 6; ++side) EXPECT_TRUE(seen.sides[side]) << side;
  EXPECT_LE(seen.count(), 9);
  EXPECT_FALSE(seen.sides[9]);
  EXPECT_FALSE(seen.isComplete());
  EXPECT_FALSE(seen.above);
}

TEST(SeenSides, CountNoSide_WhenSeenFromAbove) {
  ViewCoverage coverage;
  coverage.addDirection(Vector3f::UnitZ());
  const SeenSides seen = sidesOf(coverage, kZUp);
  EXPECT_TRUE(seen.above);
  EXPECT_EQ(seen.count(), 0);
}

TEST(SideAxes, AreLevelAndCounterclockwise) {
  const SideAxes axes = SideAxes::of({0, -2, 0}, {0.3F, 4, -1});
  EXPECT_NEAR(axes.front.dot(axes.up), 0, 1e-6);
  EXPECT_TRUE(axes.directionOf(0, 0).isApprox(axes.front, 1e-5F));
  EXPECT_TRUE(axes.directionOf(3, 0).isApprox(axes.up.cross(axes.front), 1e-5F));
  EXPECT_TRUE(axes.directionOf(5, 90).isApprox(axes.up, 1e-5F));
  // A vertical view has no level front direction; any level one is valid.
  const SideAxes steep = SideAxes::of(Vector3f::UnitZ(), Vector3f::UnitZ());
  EXPECT_NEAR(steep.front.norm(), 1, 1e-5);
  EXPECT_NEAR(steep.front.z(), 0, 1e-5);
}

TEST(NextDirection, IsTheNearestUnseenSideAtTheCamerasHeight) {
  SeenSides seen;
  seen.sides.fill(true);
  seen.sides[4] = seen.sides[9] = false;  // at 120 and 270 degrees
  const auto next = nextDirection(seen, kZUp, 3 * around(60, 40));
  ASSERT_TRUE(next);
  EXPECT_TRUE(next->isApprox(around(120, 40), 1e-4F)) << next->transpose();
  // From straight above, the direction leads down to where sides are visible.
  const auto down = nextDirection(seen, kZUp, around(250, 85));
  ASSERT_TRUE(down);
  EXPECT_TRUE(down->isApprox(around(270, 50), 1e-4F)) << down->transpose();
}

TEST(NextDirection, IsNone_WhenAllSidesWereSeen) {
  SeenSides seen;
  seen.sides.fill(true);
  EXPECT_FALSE(nextDirection(seen, kZUp, Vector3f::UnitX()));
}

}  // namespace
}  // namespace scantrove
