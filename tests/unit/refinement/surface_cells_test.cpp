#include "core/refinement/surface_cells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace scantrove {
namespace {

constexpr float kSpacing_m = 0.006F;

/// Adds a square of 30 cm at `corner`; its sides run along `u` and `v`, which are unit and perpendicular.
void addSquare(SurfaceCells& cells, const Eigen::Vector3f& corner, const Eigen::Vector3f& u,
               const Eigen::Vector3f& v) {
  for (int i = 0; i < 50; ++i) {
    for (int j = 0; j < 50; ++j) {
      const Eigen::Vector2f at = kSpacing_m * Eigen::Vector2f(static_cast<float>(i), static_cast<float>(j));
      cells.add(corner + at.x() * u + at.y() * v, u.cross(v));
    }
  }
}

/// A square whose normal is z, turned by `tilt_deg` about the y axis at its corner.
PlanarPart squareAt(const Eigen::Vector3f& corner, float tilt_deg = 0) {
  const float tilt_rad = tilt_deg * std::numbers::pi_v<float> / 180;
  SurfaceCells cells;
  addSquare(cells, corner, {std::cos(tilt_rad), 0, -std::sin(tilt_rad)}, Eigen::Vector3f::UnitY());
  return cells.planarPart().value();
}

TEST(ContinuesInPlane, IsTrue_ForSurfacesThatTouchOrAreNear) {
  const PlanarPart table = squareAt({0, 0, 0.7F});
  EXPECT_TRUE(continuesInPlane(table, squareAt({0.3F, 0, 0.7F}))) << "they touch";
  EXPECT_TRUE(continuesInPlane(table, squareAt({0.5F, 0, 0.7F}))) << "20 cm apart";
  EXPECT_FALSE(continuesInPlane(table, squareAt({0.7F, 0, 0.7F}))) << "40 cm apart";
}

TEST(ContinuesInPlane, IsFalse_WhenHeightsDiffer) {
  const PlanarPart table = squareAt({0, 0, 0.7F});
  EXPECT_TRUE(continuesInPlane(table, squareAt({0.3F, 0, 0.71F})));
  EXPECT_FALSE(continuesInPlane(table, squareAt({0.3F, 0, 0.74F})));
  EXPECT_FALSE(continuesInPlane(table, squareAt({0, 0, 0.9F}))) << "a shelf above";
}

TEST(ContinuesInPlane, IsFalse_WhenNormalsDiffer) {
  const PlanarPart table = squareAt({0, 0, 0.7F});
  EXPECT_TRUE(continuesInPlane(table, squareAt({0.3F, 0, 0.7F}, 3)));
  EXPECT_FALSE(continuesInPlane(table, squareAt({0.3F, 0, 0.7F}, 8)));
  EXPECT_FALSE(continuesInPlane(table, squareAt({0.3F, 0, 0.7F}, 180))) << "its other side";
}

TEST(SurfaceCells, PlanarPartLeavesOutOtherSides) {
  SurfaceCells cells;
  for (int i = 0; i < 4; ++i)
    addSquare(cells, {0.3F * static_cast<float>(i), 0, 0.7F}, Eigen::Vector3f::UnitX(),
              Eigen::Vector3f::UnitY());
  addSquare(cells, {0, 0, 0.4F}, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitZ());  // the front, facing -y
  const auto part = cells.planarPart();
  ASSERT_TRUE(part);
  EXPECT_NEAR(part->normal_world.z(), 1, 1e-3F);
  EXPECT_GT(part->box_world.min().z(), 0.69F);
}

TEST(SurfaceCells, HaveNoPlanarPart_WhenHalfFacesElsewhere) {
  SurfaceCells cells;
  EXPECT_FALSE(cells.planarPart()) << "without points";
  addSquare(cells, {0, 0, 0}, Eigen::Vector3f::UnitX(), Eigen::Vector3f::UnitY());
  EXPECT_TRUE(cells.planarPart());
  addSquare(cells, {0, 0, 0}, Eigen::Vector3f::UnitY(), Eigen::Vector3f::UnitZ());
  EXPECT_FALSE(cells.planarPart()) << "a floor and a wall";
}

TEST(SurfaceCells, IgnoreUnknownNormals) {
  SurfaceCells cells;
  cells.add({0, 0, 0}, Eigen::Vector3f::Zero());
  EXPECT_FALSE(cells.planarPart());
}

}  // namespace
}  // namespace scantrove
