#include "core/tracking/icp_system.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "core/tracking/kernels/icp_layout.h"

namespace scantrove::test {
namespace {

struct Pair {
  Eigen::Vector3d point, normal;
  double residual;
};

/// The sums that the kernel computes for `pairs` about `center`, in `groups` groups.
std::vector<float> sumsOf(const std::vector<Pair>& pairs, const Eigen::Vector3d& center, std::size_t groups) {
  std::vector<double> sums(groups * ICP_SUMS, 0.0);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    double* out = sums.data() + (i % groups) * ICP_SUMS;
    const Eigen::Vector3d arm = pairs[i].point - center;
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

TEST(IcpSystem, FindsTheMotion_AboutAnyCenter) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() = Eigen::AngleAxisd(0.001, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  motion.translation() << 0.002, -0.001, 0.003;
  for (const Eigen::Vector3d& center : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(3, -2, 1)}) {
    const IcpSystem system = IcpSystem::fromSums(sumsOf(cloud(motion, false), center, 3), center);
    EXPECT_EQ(system.inliers, 3000);
    EXPECT_NEAR(system.weight, 3000, 0.1);
    EXPECT_NEAR(system.radius_m, 1.0, 0.05);
    const IcpStep step = solveIcp(system, 0.004);
    ASSERT_TRUE(step.finite);
    EXPECT_EQ(step.free_directions, 0);
    EXPECT_LT((step.motion.matrix() - motion.matrix()).norm(), 1e-5);
  }
}

TEST(IcpSystem, LeavesThreeDirectionsFree_OnAPlane) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translation() << 0.02, 0.03, 0.004;
  const IcpSystem system =
      IcpSystem::fromSums(sumsOf(cloud(motion, true), Eigen::Vector3d::Zero(), 2), Eigen::Vector3d::Zero());
  const IcpStep step = solveIcp(system, 0.004);
  ASSERT_TRUE(step.finite);
  EXPECT_EQ(step.free_directions, 3);
  EXPECT_LT((step.motion.translation() - Eigen::Vector3d(0, 0, 0.004)).norm(), 1e-5);
}

TEST(IcpSystem, GivesNoMotion_WhenSumsAreZeroOrNotFinite) {
  std::vector<float> sums(ICP_SUMS, 0.0F);
  const IcpStep empty = solveIcp(IcpSystem::fromSums(sums, Eigen::Vector3d::Zero()), 0.004);
  EXPECT_FALSE(empty.finite);
  EXPECT_TRUE(empty.motion.isApprox(Eigen::Isometry3d::Identity()));

  sums = sumsOf(cloud(Eigen::Isometry3d::Identity(), false), Eigen::Vector3d::Zero(), 1);
  sums[9] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(solveIcp(IcpSystem::fromSums(sums, Eigen::Vector3d::Zero()), 0.004).finite);
  sums[9] = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(solveIcp(IcpSystem::fromSums(sums, Eigen::Vector3d::Zero()), 0.004).finite);
}

}  // namespace
}  // namespace scantrove::test
