#include "core/pipeline/standing_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace scantrove {
namespace {

/// Points of a table, seen from 0.6 m at 35 degrees, and of a box of 10 x 10 x 12 cm on it: its front and
/// top. Camera's frame; the middle of the table is on the optical axis.
struct TableView {
  Eigen::Vector3d up{0, -std::cos(0.61), -std::sin(0.61)};
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d away = up.cross(right);
  Eigen::Vector3d middle{0, 0, 0.6};
  std::vector<Eigen::Vector3d> points;

  void add(double x, double y, double z) { points.push_back(middle + x * right + y * away + z * up); }
  void addTable(double half_m) {
    for (double x = -half_m; x <= half_m; x += 0.01)
      for (double y = -half_m; y <= half_m; y += 0.01)
        if (std::abs(x) > 0.05 || std::abs(y) > 0.05) add(x, y, 0);
  }
  void addBoxOnIt() {
    for (double x = -0.05; x <= 0.05; x += 0.005) {
      for (double s = 0; s <= 0.12; s += 0.005) add(x, -0.05, s);
      for (double s = -0.05; s <= 0.05; s += 0.005) add(x, s, 0.12);
    }
  }
};

TEST(StandingPlane, IsTheTable_NotAFaceOfTheBox) {
  TableView view;
  view.addTable(0.25);
  view.addBoxOnIt();
  const auto plane = findStandingPlane(view.points, view.middle);
  ASSERT_TRUE(plane);
  EXPECT_GT(plane->normal.dot(view.up), 0.9999);
  EXPECT_NEAR(plane->heightOf(view.middle), 0, 0.0005);
  EXPECT_NEAR(plane->heightOf(view.middle + 0.12 * view.up), 0.12, 0.0005);
}

TEST(StandingPlane, IsNone_WithoutPointsAround) {
  TableView view;
  view.addTable(0.25);
  EXPECT_FALSE(findStandingPlane({}, view.middle));
  EXPECT_FALSE(findStandingPlane(view.points, view.middle + Eigen::Vector3d(0, 0, 5)));
}

TEST(StandingPlane, IsNone_WhenThePlaneHangsOver) {
  TableView view;  // a ceiling: it faces down in the image
  view.up = Eigen::Vector3d(0, std::cos(0.61), -std::sin(0.61));
  view.away = view.up.cross(view.right);
  view.addTable(0.25);
  EXPECT_FALSE(findStandingPlane(view.points, view.middle));
}

}  // namespace
}  // namespace scantrove
