#include "core/fusion/icp_system.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "core/fusion/kernels/icp_layout.h"
#include "core/fusion/pose_judgement.h"

namespace scantrove::test {
namespace {

struct Pair {
  Eigen::Vector3d point, normal;
  double residual;
};

/// The sums of the kernel over `pairs` about `centre`, in `groups` groups.
std::vector<float> sumsOf(const std::vector<Pair>& pairs, const Eigen::Vector3d& centre, std::size_t groups) {
  std::vector<double> sums(groups * ICP_SUMS, 0.0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    double* out = sums.data() + (i % groups) * ICP_SUMS;
    const Eigen::Vector3d arm = pairs[i].point - centre;
    Eigen::Matrix<double, 8, 1> J = Eigen::Matrix<double, 8, 1>::Zero();
    J << arm.cross(pairs[i].normal), pairs[i].normal, pairs[i].residual, 0;
    for (int row = 0; row < 7; ++row) {
      for (int column = 0; column < 8; ++column) out[row * 8 + column] += J(row) * J(column);
    }
    for (const int count : {ICP_INLIERS, ICP_OVERLAP, ICP_READINGS}) out[count] += 1;
    for (int k = 0; k < 3; ++k) out[ICP_POINT + k] += arm(k);
    out[ICP_POINT_2] += arm.squaredNorm();
    out[ICP_ERROR] += pairs[i].residual * pairs[i].residual;
  }
  return {sums.begin(), sums.end()};
}

std::vector<Pair> cloud(const Eigen::Isometry3d& motion, bool is_flat) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Pair> pairs;
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d p(uniform(random), uniform(random), is_flat ? 2.0 : 2.0 + uniform(random));
    const Eigen::Vector3d n =
        is_flat ? Eigen::Vector3d(0, 0, -1)
                : Eigen::Vector3d(uniform(random), uniform(random), uniform(random)).normalized();
    pairs.push_back({p, n, n.dot(motion * p - p)});
  }
  return pairs;
}

TEST(IcpSystem, SolvesForTheMotionAboutAnyCentre) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = Eigen::AngleAxisd(0.001, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  motion.translation() << 0.002, -0.001, 0.003;
  for (const Eigen::Vector3d& centre : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(3, -2, 1)}) {
    const IcpSystem system = IcpSystem::fromSums(sumsOf(cloud(motion, false), centre, 3), centre);
    EXPECT_EQ(system.inliers, 3000);
    EXPECT_NEAR(system.weight, 3000, 0.1);
    EXPECT_NEAR(system.radius_m, 1.0, 0.05);
    const IcpStep step = solveIcp(system, 0.004);
    ASSERT_TRUE(step.finite);
    EXPECT_EQ(step.free_directions, 0);
    EXPECT_LT((step.motion.matrix() - motion.matrix()).norm(), 1e-5);
  }
}

TEST(IcpSystem, APlaneDeterminesThreeDirectionsOnly) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translation() << 0.02, 0.03, 0.004;
  const IcpSystem system =
      IcpSystem::fromSums(sumsOf(cloud(motion, true), Eigen::Vector3d::Zero(), 2), Eigen::Vector3d::Zero());
  const IcpStep step = solveIcp(system, 0.004);
  ASSERT_TRUE(step.finite);
  EXPECT_EQ(step.free_directions, 3);
  EXPECT_LT((step.motion.translation() - Eigen::Vector3d(0, 0, 0.004)).norm(), 1e-5);
}

TEST(IcpSystem, NothingAndNonsenseGiveNoMotion) {
  std::vector<float> sums(ICP_SUMS, 0.0F);
  const IcpStep nothing = solveIcp(IcpSystem::fromSums(sums, Eigen::Vector3d::Zero()), 0.004);
  EXPECT_FALSE(nothing.finite);
  EXPECT_TRUE(nothing.motion.isApprox(Eigen::Isometry3d::Identity()));

  sums = sumsOf(cloud(Eigen::Isometry3d::Identity(), false), Eigen::Vector3d::Zero(), 1);
  sums[9] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(solveIcp(IcpSystem::fromSums(sums, Eigen::Vector3d::Zero()), 0.004).finite);
  sums[9] = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(solveIcp(IcpSystem::fromSums(sums, Eigen::Vector3d::Zero()), 0.004).finite);
}

/// What a good pose of a 320 x 240 image leaves behind.
IcpOutcome goodOutcome() {
  IcpOutcome outcome;
  outcome.pixels = 76800;
  outcome.system.readings = 60000;
  outcome.system.overlap = 55000;
  outcome.system.inliers = 50000;
  outcome.system.weight = 10000;
  outcome.system.fit_residual_m = 0.004;
  outcome.system.squared_error = 50000 * 0.006 * 0.006;
  outcome.step.finite = true;
  return outcome;
}

constexpr double kDepthNoise_m = 0.0015;

TEST(PoseJudgement, TrustsWhatIsWellFoundedOnly) {
  const Eigen::Isometry3d still = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d far = still;
  far.translation().x() = 0.1;
  EXPECT_EQ(judgePose(goodOutcome(), still, false, kDepthNoise_m).state, TrackingState::tracking);
  EXPECT_NEAR(judgePose(goodOutcome(), still, false, kDepthNoise_m).inlier_fraction, 50.0 / 55.0, 1e-12);
  EXPECT_NEAR(judgePose(goodOutcome(), still, false, kDepthNoise_m).rmse_m, 0.006, 1e-12);
  EXPECT_EQ(judgePose(goodOutcome(), far, true, kDepthNoise_m).state, TrackingState::tracking);

  const auto expectState = [](TrackingState state, const Eigen::Isometry3d& motion, auto&& change) {
    IcpOutcome outcome = goodOutcome();
    change(outcome);
    EXPECT_EQ(judgePose(outcome, motion, false, kDepthNoise_m).state, state);
  };
  using enum TrackingState;
  IcpOutcome noisy = goodOutcome();
  noisy.system.fit_residual_m = 0.02;
  EXPECT_EQ(judgePose(noisy, still, false, kDepthNoise_m).state, uncertain);
  EXPECT_EQ(judgePose(noisy, still, false, 3 * kDepthNoise_m).state, tracking) << "so noisy a camera";
  expectState(uncertain, still, [](IcpOutcome& o) { o.step.free_directions = 1; });
  expectState(uncertain, still, [](IcpOutcome& o) { o.step.rotation_rad = 0.01; });
  expectState(uncertain, still, [](IcpOutcome& o) { o.system.inliers = 20000; });
  expectState(uncertain, still, [](IcpOutcome& o) { o.system.fit_residual_m = 0.02; });
  expectState(tracking, still, [](IcpOutcome& o) { o.system.inliers = 34000; });
  expectState(uncertain, far, [](IcpOutcome& o) { o.system.inliers = 34000; });
  expectState(uncertain, still, [](IcpOutcome& o) { o.system.overlap = 4000, o.system.inliers = 3900; });
  far.translation().x() = 0.5;
  expectState(uncertain, far, [](IcpOutcome&) {});
  expectState(lost, still, [](IcpOutcome& o) { o.system.inliers = 5000; });
  expectState(lost, still, [](IcpOutcome& o) { o.system.overlap = 1000, o.system.inliers = 1000; });
  expectState(lost, still, [](IcpOutcome& o) { o.step.finite = false; });
}

}  // namespace
}  // namespace scantrove::test
