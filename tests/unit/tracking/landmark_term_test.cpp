#include "core/tracking/landmark_term.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/support/poses.h"

namespace scantrove::test {
namespace {

/// Landmarks in a room, observed by a camera at `T_world_depth`.
SeenLandmarks seenFrom(const Eigen::Isometry3d& T_world_depth) {
  cv::RNG random(5);
  SeenLandmarks seen;
  seen.K = {520, 530, 320, 240, 640, 480};
  seen.T_color_depth = pose(0, 2, 1, -0.025, 0.003, 0);
  const Eigen::Isometry3d T_color_world = seen.T_color_depth * T_world_depth.inverse();
  while (seen.pixels.size() < 60) {
    const Eigen::Vector3d p(random.uniform(-1.0, 1.0), random.uniform(-0.8, 0.8), random.uniform(1.0, 3.0));
    const Eigen::Vector3d q = T_color_world * p;
    seen.points_world.push_back(p);
    seen.pixels.emplace_back(520 * q.x() / q.z() + 320, 530 * q.y() / q.z() + 240);
  }
  return seen;
}

TEST(SeenLandmarks, ErrorMeasuresTheDeviationOfAPose) {
  const Eigen::Isometry3d truth = pose(5, 10, -3, 0.1, 0.2, -0.3);
  SeenLandmarks seen = seenFrom(truth);
  EXPECT_NEAR(seen.errorPx(truth), 0, 1e-9);
  // A turn of 1 degree moves the image centre by f tan(1 degree).
  EXPECT_NEAR(seen.errorPx(truth * pose(0, 1, 0, 0, 0, 0)), 520 * std::tan(kDegree), 1.5);
  for (std::size_t i = 0; i < 20; ++i) seen.pixels[i].x() += 100;  // a third is wrong
  EXPECT_LT(seen.errorPx(truth), 1e-9);
  EXPECT_FALSE(SeenLandmarks{}.errorPx(truth) < 1e6);
}

TEST(SeenLandmarks, CellsCountsOccupiedCells) {
  SeenLandmarks seen;
  seen.K = {520, 520, 320, 240, 640, 480};
  EXPECT_EQ(seen.cells(), 0);
  seen.pixels = {{1, 1}, {79, 79}, {81, 1}, {639, 479}};
  EXPECT_EQ(seen.cells(), 3);
}

// Gauss-Newton on this term alone converges only with correct signs and derivatives.
TEST(LandmarkTerm, ConvergesToTheTruePose) {
  const Eigen::Isometry3d truth = pose(5, 10, -3, 0.1, 0.2, -0.3);
  const SeenLandmarks seen = seenFrom(truth);
  Eigen::Isometry3d T = truth * pose(2, -3, 1, 0.05, -0.04, 0.06);
  const Eigen::Vector3d center(0.2, -0.1, 1.5);
  for (int i = 0; i < 20; ++i) {
    const LandmarkTerm term = LandmarkTerm::of(seen, T, center);
    EXPECT_NEAR(term.weight, term.JtJ.diagonal().tail<3>().sum(), 1e-12);
    const Eigen::Matrix<double, 6, 1> x = term.JtJ.ldlt().solve(term.Jtr);
    const Eigen::Vector3d turn = x.head<3>();
    const Eigen::Matrix3d R = turn.norm() > 0
                                  ? Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix()
                                  : Eigen::Matrix3d::Identity();
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.linear() = R;
    motion.translation() = center + x.tail<3>() - R * center;
    T = motion * T;
  }
  EXPECT_LT((T.matrix() - truth.matrix()).norm(), 1e-6);
}

// An error of one pixel is equally likely in both directions, so a pixel of twice the height weighs half.
TEST(LandmarkTerm, WeighsRowsByTheirOwnFocalLength) {
  SeenLandmarks seen;
  seen.K = {500, 250, 320, 120, 640, 240};
  seen.points_world = {{0, 0, 2}};
  seen.pixels = {{320.5, 120.25}};
  const LandmarkTerm term = LandmarkTerm::of(seen, Eigen::Isometry3d::Identity(), Eigen::Vector3d::Zero());
  EXPECT_NEAR(term.JtJ(3, 3), 1 / 4.0, 1e-9);
  EXPECT_NEAR(term.JtJ(4, 4), 1 / 16.0, 1e-9);
  // The same error in metres.
  EXPECT_NEAR(term.Jtr(4), term.Jtr(3) / 4, 1e-9);
}

}  // namespace
}  // namespace scantrove::test
