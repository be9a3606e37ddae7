#include "ui/scene/up_direction.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace scantrove {
namespace {

/// Normals with noise and any sign: `floors` of them along `floor`, `walls` along `wall`.
std::vector<Eigen::Vector3f> room(const Eigen::Vector3f& floor, int floors, const Eigen::Vector3f& wall,
                                  int walls) {
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0, 0.03F);
  std::bernoulli_distribution flip(0.5);
  std::vector<Eigen::Vector3f> normals;
  for (int i = 0; i < floors + walls; ++i) {
    const Eigen::Vector3f& base = i < floors ? floor : wall;
    const Eigen::Vector3f n =
        (base + Eigen::Vector3f(noise(random), noise(random), noise(random))).normalized() * 50;
    normals.emplace_back(flip(random) ? n : Eigen::Vector3f(-n));
  }
  return normals;
}

/// Up and horizontal backward directions for a camera at the identity pose that looks `pitch` below the
/// horizon.
Eigen::Vector3f upAt(float pitch) { return {0, -std::cos(pitch), -std::sin(pitch)}; }
Eigen::Vector3f backAt(float pitch) { return {0, std::sin(pitch), -std::cos(pitch)}; }

TEST(FindUp, UsesTheFloor_WhenTheCameraIsTilted) {
  const Eigen::Vector3f up = findUp(room(upAt(0.6F), 270, backAt(0.6F), 130), Eigen::Matrix3f::Identity());
  EXPECT_GT(up.dot(upAt(0.6F)), 0.999F);
}

TEST(FindUp, DistinguishesWallAndTable_AtAnyPitch) {
  for (const float pitch : {0.1F, 0.5F, 0.9F, 1.2F}) {
    const Eigen::Vector3f up =
        findUp(room(upAt(pitch), 100, backAt(pitch), 400), Eigen::Matrix3f::Identity());
    EXPECT_GT(up.dot(upAt(pitch)), 0.999F) << pitch;
  }
}

TEST(FindUp, KeepsTheGuess_WithoutEvidence) {
  const Eigen::Vector3f guess = -Eigen::Vector3f::UnitY();
  EXPECT_EQ(findUp({}, Eigen::Matrix3f::Identity()), guess);
  EXPECT_EQ(findUp(std::vector<Eigen::Vector3f>(10, Eigen::Vector3f::UnitX()), Eigen::Matrix3f::Identity()),
            guess);
}

}  // namespace
}  // namespace scantrove
