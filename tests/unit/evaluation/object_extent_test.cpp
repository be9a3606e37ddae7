#include "core/evaluation/object_extent.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <vector>

namespace scantrove {
namespace {

TEST(LongestSide, IsThatOfABox_WhenTurned) {
  const Eigen::AngleAxisf turn(0.7F, Eigen::Vector3f(1, 2, 3).normalized());
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i <= 20; ++i) {
    for (int k = 0; k <= 10; ++k) {
      for (int l = 0; l <= 4; ++l) {
        points.push_back(turn * Eigen::Vector3f(0.02F * static_cast<float>(i), 0.02F * static_cast<float>(k),
                                                0.02F * static_cast<float>(l)) +
                         Eigen::Vector3f(1, 2, 3));
      }
    }
  }
  EXPECT_NEAR(longestSide(points), 0.4, 0.001);
  points.push_back({9, 9, 9});  // one outlier
  EXPECT_NEAR(longestSide(points), 0.4, 0.02);
}

TEST(LongestSide, IsZero_WhenPointsAreTooFew) {
  EXPECT_EQ(longestSide({}), 0);
  const std::vector<Eigen::Vector3f> two{{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(longestSide(two), 0);
}

}  // namespace
}  // namespace scantrove
