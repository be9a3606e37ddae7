#include "core/tracking/pose_judgment.h"

#include <gtest/gtest.h>

namespace scantrove::test {
namespace {

using enum TrackingState;

constexpr double kDepthNoise_m = 0.0015;

/// The ICP outcome of a good pose for a 320 x 240 image.
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

/// The start pose of ICP if it moved the pose by `x_m`.
Eigen::Isometry3d movedBy(double x_m) { return Eigen::Isometry3d(Eigen::Translation3d(-x_m, 0, 0)); }

TrackingState judged(const IcpOutcome& outcome, GuessOrigin origin, double moved_m = 0,
                     double noise_m = kDepthNoise_m) {
  return judgePose(outcome, movedBy(moved_m), origin, noise_m).state;
}

template <class Change>
IcpOutcome changed(Change change) {
  IcpOutcome outcome = goodOutcome();
  change(outcome);
  return outcome;
}

TEST(JudgePose, ReportsInliersAndError) {
  const PoseEstimate pose = judgePose(goodOutcome(), movedBy(0), GuessOrigin::prediction, kDepthNoise_m);
  EXPECT_EQ(pose.state, tracking);
  EXPECT_NEAR(pose.inlier_fraction, 50.0 / 55.0, 1e-12);
  EXPECT_NEAR(pose.rmse_m, 0.006, 1e-12);
}

TEST(JudgePose, TrustsTheDevice_WhereTheSurfaceLeavesDirectionsFree) {
  const IcpOutcome wall = changed([](IcpOutcome& o) { o.step.free_directions = 3; });
  EXPECT_EQ(judged(wall, GuessOrigin::device), tracking);
  EXPECT_EQ(judged(wall, GuessOrigin::device, 0.5), uncertain) << "beyond its reach";
  EXPECT_EQ(judged(changed([](IcpOutcome& o) { o.system.inliers = 20000; }), GuessOrigin::device), uncertain);
}

TEST(JudgePose, IsUncertainOrLost_WhenEvidenceIsWeak) {
  constexpr GuessOrigin kOrigin = GuessOrigin::prediction;
  const IcpOutcome noisy = changed([](IcpOutcome& o) { o.system.fit_residual_m = 0.02; });
  EXPECT_EQ(judged(noisy, kOrigin), uncertain);
  EXPECT_EQ(judged(noisy, kOrigin, 0, 3 * kDepthNoise_m), tracking) << "within the noise of the camera";
  EXPECT_EQ(judged(changed([](IcpOutcome& o) { o.step.free_directions = 1; }), kOrigin), uncertain);
  EXPECT_EQ(judged(changed([](IcpOutcome& o) { o.step.rotation_rad = 0.01; }), kOrigin), uncertain);
  EXPECT_EQ(judged(changed([](IcpOutcome& o) { o.system.inliers = 20000; }), kOrigin), uncertain);
  EXPECT_EQ(judged(changed([](IcpOutcome& o) { o.system.inliers = 5000; }), kOrigin), lost);
  EXPECT_EQ(judged(changed([](IcpOutcome& o) { o.step.finite = false; }), kOrigin), lost);
}

TEST(JudgePose, NeedsMoreInliers_AfterASearchOrLongMotion) {
  EXPECT_EQ(judged(goodOutcome(), GuessOrigin::search, 0.1), tracking);
  const IcpOutcome half = changed([](IcpOutcome& o) { o.system.inliers = 34000; });
  EXPECT_EQ(judged(half, GuessOrigin::prediction), tracking);
  EXPECT_EQ(judged(half, GuessOrigin::prediction, 0.1), uncertain);
  EXPECT_EQ(judged(half, GuessOrigin::search), uncertain);
  EXPECT_EQ(judged(goodOutcome(), GuessOrigin::prediction, 0.5), uncertain) << "too fast for a hand";
}

TEST(JudgePose, TrustsLandmarks_WhenGeometryIsFree) {
  const IcpOutcome wall = changed([](IcpOutcome& o) { o.step.free_directions = 3; });
  EXPECT_EQ(judged(wall, GuessOrigin::prediction), uncertain);
  EXPECT_EQ(judged(wall, GuessOrigin::landmarks), tracking);
  const IcpOutcome elsewhere = changed([](IcpOutcome& o) { o.landmark_error_px = 8; });
  EXPECT_EQ(judged(elsewhere, GuessOrigin::landmarks), uncertain) << "depth and colour disagree";
}

// A near object enters the view: half the image lies in front of the known wall.
TEST(JudgePose, AcceptsNewSurfaces_InFrontOfKnownOnes) {
  const auto half = [](int before, int behind) {
    return changed([&](IcpOutcome& o) {
      o.system.inliers = 20000;
      o.system.before = before;
      o.system.behind = behind;
    });
  };
  EXPECT_EQ(judged(half(30000, 1000), GuessOrigin::prediction), tracking);
  EXPECT_EQ(judged(half(17000, 16000), GuessOrigin::prediction), uncertain) << "a wrong pose looks the same";
  EXPECT_EQ(judged(half(0, 30000), GuessOrigin::prediction), uncertain) << "nothing is visible behind a wall";
  EXPECT_EQ(judged(half(30000, 1000), GuessOrigin::key_frame), uncertain)
      << "the camera was not tracked here";
}

TEST(JudgePose, AcceptsLittleOverlap_WhenItIsFirm) {
  const auto known = [](bool is_firm, int inliers) {
    return changed([&](IcpOutcome& o) {
      o.system.overlap = 9000;
      o.system.inliers = inliers;
      o.step.is_firm = is_firm;
    });
  };
  EXPECT_EQ(judged(known(true, 7500), GuessOrigin::prediction), tracking);
  EXPECT_EQ(judged(known(false, 7500), GuessOrigin::prediction), uncertain);
  EXPECT_EQ(judged(known(true, 5500), GuessOrigin::prediction), uncertain)
      << "a small overlap needs a better fit";
}

TEST(JudgePose, NeedsMoreInliers_ForAKeyFrame) {
  const IcpOutcome half = changed([](IcpOutcome& o) { o.system.inliers = 30000; });
  EXPECT_EQ(judged(half, GuessOrigin::landmarks), tracking);
  EXPECT_EQ(judged(half, GuessOrigin::key_frame), uncertain);
  EXPECT_EQ(judged(goodOutcome(), GuessOrigin::key_frame), tracking);
}

}  // namespace
}  // namespace scantrove::test
