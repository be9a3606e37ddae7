#include "core/evaluation/trajectory_metrics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace scantrove {
namespace {

StampedPose at(double t, double x, double y = 0, double z = 0) {
  StampedPose pose;
  pose.timestamp_s = t;
  pose.T_world_camera.translation() << x, y, z;
  return pose;
}

/// A wavy path of a turning camera.
Trajectory wavyPath(int count) {
  Trajectory poses;
  for (int i = 0; i < count; ++i) {
    const double a = 0.1 * i;
    StampedPose pose = at(i / 30.0, std::cos(a), std::sin(2 * a), 0.3 * a);
    pose.T_world_camera.linear() =
        Eigen::AngleAxisd(a, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
    poses.push_back(pose);
  }
  return poses;
}

Trajectory moved(Trajectory poses, const Eigen::Isometry3d& T) {
  for (StampedPose& pose : poses) pose.T_world_camera = T * pose.T_world_camera;
  return poses;
}

Eigen::Isometry3d someMotion() {
  return Eigen::Translation3d(3, -1, 2) *
         Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.2, 0.9, -0.4).normalized());
}

TEST(SummarizeErrors, ReturnsKnownStatistics) {
  const ErrorSummary summary = summarizeErrors({4, 1, 3, 2});
  EXPECT_DOUBLE_EQ(summary.mean, 2.5);
  EXPECT_DOUBLE_EQ(summary.median, 2.5);
  EXPECT_DOUBLE_EQ(summary.max, 4);
  EXPECT_DOUBLE_EQ(summary.rmse, std::sqrt(30.0 / 4));
  EXPECT_EQ(summary.count, 4);
  EXPECT_EQ(summarizeErrors({}).count, 0);
  EXPECT_DOUBLE_EQ(summarizeErrors({5, 1, 9}).median, 5);
}

TEST(Associate, PairsTheNearestPose_WithinTheLimit) {
  const Trajectory truth{at(0.00, 0), at(0.05, 1), at(0.10, 2), at(0.50, 3)};
  const Trajectory estimate{at(0.02, 10), at(0.031, 11), at(0.071, 12), at(0.11, 13), at(0.30, 14)};
  const auto pairs = associate(estimate, truth);
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs[0].estimate.timestamp_s, 0.02);  // exactly at the limit
  EXPECT_EQ(pairs[1].estimate.timestamp_s, 0.031);
  EXPECT_EQ(pairs[1].truth.timestamp_s, 0.05);
  EXPECT_EQ(pairs[2].estimate.timestamp_s, 0.11);
}

TEST(Associate, UsesEachTruePoseOnce_ForTheNearest) {
  const Trajectory truth{at(1.0, 0)};
  const Trajectory estimate{at(0.99, 1), at(1.001, 2), at(1.01, 3)};
  const auto pairs = associate(estimate, truth);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].estimate.timestamp_s, 1.001);
  EXPECT_TRUE(associate({}, truth).empty());
  EXPECT_TRUE(associate(estimate, {}).empty());
}

TEST(Associate, EqualsBruteForceOnRandomTimes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> time(0, 10);
  Trajectory truth, estimate;
  for (int i = 0; i < 300; ++i) truth.push_back(at(time(random), 0));
  for (int i = 0; i < 200; ++i) estimate.push_back(at(time(random), 0));
  const auto earlier = [](const StampedPose& a, const StampedPose& b) {
    return a.timestamp_s < b.timestamp_s;
  };
  std::sort(truth.begin(), truth.end(), earlier);
  std::sort(estimate.begin(), estimate.end(), earlier);
  std::map<double, double> best;  // truth -> estimate
  for (const StampedPose& e : estimate) {
    double nearest = 1e9;
    for (const StampedPose& t : truth) {
      if (std::abs(t.timestamp_s - e.timestamp_s) < std::abs(nearest - e.timestamp_s))
        nearest = t.timestamp_s;
    }
    if (std::abs(nearest - e.timestamp_s) > 0.02) continue;
    const auto previous = best.find(nearest);
    if (previous == best.end() || std::abs(nearest - e.timestamp_s) < std::abs(nearest - previous->second)) {
      best[nearest] = e.timestamp_s;
    }
  }
  const auto pairs = associate(estimate, truth);
  ASSERT_EQ(pairs.size(), best.size());
  for (const PosePair& pair : pairs) EXPECT_EQ(best.at(pair.truth.timestamp_s), pair.estimate.timestamp_s);
}

TEST(Align, FindsAKnownMotion) {
  const Trajectory truth = wavyPath(50);
  const Trajectory estimate = moved(truth, someMotion().inverse());
  EXPECT_TRUE(alignRigidly(associate(estimate, truth)).isApprox(someMotion(), 1e-9));
}

TEST(Align, ReturnsARotation_ForPlanarAndMirroredPaths) {
  Trajectory truth, estimate;
  for (int i = 0; i < 10; ++i) {
    truth.push_back(at(i, i, i * i % 7, 0));
    estimate.push_back(at(i, i, i * i % 7, 0));
  }
  EXPECT_NEAR(alignRigidly(associate(estimate, truth)).linear().determinant(), 1, 1e-9);
  for (StampedPose& pose : estimate) pose.T_world_camera.translation().x() *= -1;
  EXPECT_NEAR(alignRigidly(associate(estimate, truth)).linear().determinant(), 1, 1e-9);
  const Trajectory one{at(0, 5)};
  EXPECT_TRUE(
      (alignRigidly(associate(one, Trajectory{at(0, 7)})).translation() - Eigen::Vector3d(2, 0, 0)).norm() <
      1e-9);
}

TEST(Align, HasLowerCostThanNearbyMotions) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.05);
  const Trajectory truth = wavyPath(40);
  Trajectory estimate = moved(truth, someMotion());
  for (StampedPose& pose : estimate) {
    pose.T_world_camera.translation() += Eigen::Vector3d(noise(random), noise(random), noise(random));
  }
  const auto pairs = associate(estimate, truth);
  const auto cost = [&](const Eigen::Isometry3d& T) {
    double sum = 0;
    for (const PosePair& pair : pairs) {
      sum += (pair.truth.T_world_camera.translation() - T * pair.estimate.T_world_camera.translation())
                 .squaredNorm();
    }
    return sum;
  };
  const Eigen::Isometry3d best = alignRigidly(pairs);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d axis = Eigen::Vector3d(noise(random), noise(random), noise(random)).normalized();
    const Eigen::Isometry3d nudge =
        Eigen::Translation3d(0.1 * noise(random), 0.1 * noise(random), 0.1 * noise(random)) *
        Eigen::AngleAxisd(0.1 * noise(random), axis);
    EXPECT_LE(cost(best), cost(nudge * best));
  }
}

TEST(AbsoluteTrajectoryError, IsZero_AfterARigidMotionButNotAfterScaling) {
  const Trajectory truth = wavyPath(60);
  EXPECT_NEAR(absoluteTrajectoryError(associate(moved(truth, someMotion()), truth)).rmse, 0, 1e-9);
  Trajectory scaled = truth;
  for (StampedPose& pose : scaled) pose.T_world_camera.translation() *= 1.1;
  EXPECT_GT(absoluteTrajectoryError(associate(scaled, truth)).rmse, 0.05);
}

TEST(AbsoluteTrajectoryError, ReturnsAKnownError) {
  // Two lines whose ends differ by +-0.1 along the line: no rigid motion reduces the error.
  const Trajectory truth{at(0, -1), at(1, 1)};
  const Trajectory estimate{at(0, -1.1), at(1, 1.1)};
  const ErrorSummary error = absoluteTrajectoryError(associate(estimate, truth));
  EXPECT_NEAR(error.rmse, 0.1, 1e-12);
  EXPECT_NEAR(error.max, 0.1, 1e-12);
  EXPECT_EQ(error.count, 2);
}

TEST(RelativePoseError, IsTheDriftPerStep_WhenDriftIsConstant) {
  const double turn = 0.01;
  Trajectory truth, estimate;
  for (int i = 0; i < 11; ++i) {
    truth.push_back(at(i, 0.1 * i));
    StampedPose pose = at(i, 0.1 * i + 0.002 * i);
    pose.T_world_camera.linear() = Eigen::AngleAxisd(turn * i, Eigen::Vector3d::UnitX()).toRotationMatrix();
    estimate.push_back(pose);
  }
  const auto pairs = associate(estimate, truth);
  const RelativePoseError one = relativePoseError(pairs, 1);
  EXPECT_EQ(one.translation_m.count, 10);
  EXPECT_NEAR(one.translation_m.rmse, 0.002, 1e-12);
  EXPECT_NEAR(one.rotation_deg.mean, turn * 180 / std::numbers::pi, 1e-9);
  const RelativePoseError five = relativePoseError(pairs, 5);
  EXPECT_EQ(five.translation_m.count, 6);
  EXPECT_NEAR(five.translation_m.max, 0.01, 1e-12);
  EXPECT_NEAR(five.rotation_deg.median, 5 * turn * 180 / std::numbers::pi, 1e-9);
  EXPECT_EQ(relativePoseError(pairs, 11).translation_m.count, 0);
}

TEST(RelativePoseError, DoesNotDependOnTheWorldFrame) {
  const Trajectory truth = wavyPath(30);
  const auto error = relativePoseError(associate(moved(truth, someMotion()), truth), 1);
  EXPECT_NEAR(error.translation_m.max, 0, 1e-9);
  EXPECT_NEAR(error.rotation_deg.max, 0, 1e-5);
}

}  // namespace
}  // namespace scantrove
