#include "ui/scene/up_direction.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

namespace scantrove {
namespace {

TEST(FindUp, TakesTheFloorOverTheCamerasTilt) {
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0, 0.03F);
  std::bernoulli_distribution flip(0.5);
  const Eigen::Vector3f floor = Eigen::Vector3f(0.1F, -0.8F, -0.55F).normalized();
  const Eigen::Vector3f wall = floor.unitOrthogonal();
  std::vector<Eigen::Vector3f> normals;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3f base = i % 3 == 0 ? wall : floor;
    Eigen::Vector3f n =
        (base + Eigen::Vector3f(noise(random), noise(random), noise(random))).normalized() * 50;
    normals.emplace_back(flip(random) ? n : Eigen::Vector3f(-n));
  }
  const Eigen::Vector3f up = findUp(normals, -Eigen::Vector3f::UnitY());
  EXPECT_GT(up.dot(floor), 0.999F);
}

TEST(FindUp, KeepsTheGuessWithoutEvidence) {
  const Eigen::Vector3f guess = -Eigen::Vector3f::UnitY();
  EXPECT_EQ(findUp({}, guess), guess);
  EXPECT_EQ(findUp(std::vector<Eigen::Vector3f>(10, Eigen::Vector3f::UnitX()), guess), guess);
}

}  // namespace
}  // namespace scantrove
