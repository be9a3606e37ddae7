#include "core/tracking/surface_aligner.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "core/fusion/depth_preprocessor.h"
#include "core/tracking/icp_pass.h"
#include "core/tracking/pose_judgment.h"
#include "tests/kernels/tracking/tracking_test_support.h"
#include "tests/reference/icp_reference.h"
#include "tests/support/each_device.h"

namespace scantrove::test {
namespace {

const Intrinsics kWorking = kKinect.resizedTo(320, 240);

struct Rig {
  std::unique_ptr<DepthPreprocessor> preprocessor;
  std::unique_ptr<SurfaceAligner> aligner;
  double depth_noise_m;

  explicit Rig(ComputeContext& compute, const FusionParams& params = {})
      : preprocessor(std::move(*DepthPreprocessor::create(compute, kKinect, params))),
        aligner(std::move(*SurfaceAligner::create(compute, params.depth_noise_m))),
        depth_noise_m(static_cast<double>(params.depth_noise_m)) {}

  [[nodiscard]] PoseEstimate track(const DepthPyramid& frame, const SurfaceMaps& model,
                                   const Eigen::Isometry3d& prediction) const {
    const std::array guesses{prediction, model.T_world_camera};
    return judgePose(aligner->align(frame, model, guesses), model.T_world_camera, GuessOrigin::prediction,
                     depth_noise_m);
  }
  /// After a tracking failure: starts from several rotations of the camera.
  [[nodiscard]] PoseEstimate search(const DepthPyramid& frame, const SurfaceMaps& model) const {
    return judgePose(aligner->alignTurned(frame, model), model.T_world_camera, GuessOrigin::search,
                     depth_noise_m);
  }
};

double translationBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.inverse() * b).translation().norm();
}
double degreesBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd((a.inverse() * b).linear()).angle() / kDegree;
}

std::vector<Eigen::Vector4d> widened(const std::vector<cl_float4>& map) {
  std::vector<Eigen::Vector4d> result;
  for (const cl_float4& e : map) {
    result.emplace_back(static_cast<double>(e.s[0]), static_cast<double>(e.s[1]), static_cast<double>(e.s[2]),
                        static_cast<double>(e.s[3]));
  }
  return result;
}

TEST(IcpPass, SumsMatchTheFormula) {
  onEachWidth([](ComputeContext& compute) {
    const AnalyticScene scene = roomCorner();
    Rig rig(compute);
    const Eigen::Isometry3d T_model = pose(2, -3, 1, 0.05, -0.02, 0.1);
    const Eigen::Isometry3d T_frame = T_model * pose(0.5, 0.7, -0.4, 0.01, 0.005, -0.01);
    const SurfaceMaps model = mapsOf(compute, scene, kWorking, T_model);
    const DepthPyramid& frame = rig.preprocessor->process(frameOf(scene, kKinect, T_model));
    auto pass = IcpPass::create(compute);
    ASSERT_TRUE(pass) << pass.error().message();
    const IcpGates gates = IcpGates::of(0.05F, FusionParams{}.depth_noise_m);
    for (const DepthPyramid::Level& level : frame.levels) {
      const IcpSystem system = pass->run(level, model, T_frame, gates);
      const reference::IcpSums expected = reference::accumulateIcp(
          widened(level.vertices_camera.read(compute.queue())),
          widened(level.normals_camera.read(compute.queue())), T_frame,
          widened(model.vertices_world.read(compute.queue())),
          widened(model.normals_world.read(compute.queue())), T_model, kWorking, system.center,
          {static_cast<double>(gates.distance_m), static_cast<double>(gates.distance_per_z2),
           static_cast<double>(gates.normal_cosine), static_cast<double>(gates.huber_m),
           static_cast<double>(gates.noise_per_z2), static_cast<double>(gates.fit_huber_m),
           static_cast<double>(gates.fit_noise_per_z2)});
      EXPECT_EQ(system.readings, expected.readings);
      // Float rounding may decide otherwise for pixels at the border of the image or of a gate.
      EXPECT_NEAR(system.overlap, expected.overlap, 1 + level.K.pixels() / 5000);
      EXPECT_NEAR(system.before, expected.before, 1 + level.K.pixels() / 5000);
      EXPECT_NEAR(system.behind, expected.behind, 1 + level.K.pixels() / 5000);
      EXPECT_NEAR(system.inliers, expected.inliers, 1 + level.K.pixels() / 2000);
      EXPECT_GT(system.inliers, level.K.pixels() / 2);
      // Those pixels, and sums of 600 floats of 24 bits, allow this relative error.
      EXPECT_LT((system.JtJ - expected.JtJ).norm() / expected.JtJ.norm(), 2e-3);
      EXPECT_LT((system.Jtr - expected.Jtr).norm() / expected.Jtr.norm(), 2e-2);
      EXPECT_NEAR(system.fit_residual_m, std::sqrt(expected.fit_error / expected.fit_weight), 1e-5);
      EXPECT_NEAR(system.squared_error / expected.squared_error, 1, 1e-2);
    }
  });
}

TEST(IcpPass, CountsSurfaceBeforeAndBehindTheModel) {
  onEachWidth([](ComputeContext& compute) {
    const Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    const AnalyticScene known = roomCorner();
    AnalyticScene with_ball = roomCorner();
    with_ball.sphere({0, 0, 1.2}, 0.2);
    const auto counts = [&](const AnalyticScene& model, const AnalyticScene& seen) {
      Rig rig(compute);
      const SurfaceMaps maps = mapsOf(compute, model, kWorking, T);
      auto pass = IcpPass::create(compute);
      const DepthPyramid& frame = rig.preprocessor->process(frameOf(seen, kKinect, T));
      return pass.value().run(frame.levels.front(), maps, T,
                              IcpGates::of(0.05F, FusionParams{}.depth_noise_m));
    };
    // The ball's disc in the image: radius f r / sqrt(d^2 - r^2).
    const double radius = 292.5 * 0.2 / std::sqrt(1.2 * 1.2 - 0.2 * 0.2);
    const double disc = std::numbers::pi * radius * radius;
    EXPECT_NEAR(counts(known, with_ball).before / disc, 1, 0.05);
    EXPECT_LT(counts(known, with_ball).behind, 0.02 * disc);
    EXPECT_NEAR(counts(with_ball, known).behind / disc, 1, 0.05);
    EXPECT_LT(counts(with_ball, known).before, 0.02 * disc);
  });
}

// Larger residuals are acceptable if they match the known noise of the camera.
TEST(IcpPass, ScalesResiduals_ByTheNoiseOfTheCamera) {
  onEachWidth([](ComputeContext& compute) {
    const SurfaceMaps model = mapsOf(compute, roomCorner(), kWorking, Eigen::Isometry3d::Identity());
    auto pass = IcpPass::create(compute);
    ASSERT_TRUE(pass) << pass.error().message();
    /// The residual of readings with `noise_m` of noise, divided by the expected noise.
    const auto residual = [&](float noise_m, float expected_noise_m) {
      std::mt19937 random(2);
      std::normal_distribution<float> noise(0.0F, noise_m);
      std::vector<cl_float4> vertices = model.vertices_world.read(compute.queue());
      for (cl_float4& v : vertices) {
        const float stretch = 1 + noise(random) * v.s[2];  // dz = noise z^2
        for (int axis = 0; axis < 3; ++axis) v.s[axis] *= stretch;
      }
      const DepthPyramid::Level level{kWorking, Buffer<cl_float4>(compute.context(), vertices.size()),
                                      model.normals_world};
      Buffer<cl_float4> readings = level.vertices_camera;
      readings.write(compute.queue(), vertices);
      const IcpSystem system =
          pass->run(level, model, Eigen::Isometry3d::Identity(), IcpGates::of(0.10F, expected_noise_m));
      EXPECT_GT(system.inliers, 0.95 * system.overlap);
      return system.fit_residual_m / double{expected_noise_m};
    };
    EXPECT_LT(residual(0.0015F, 0.0015F), 6);
    EXPECT_NEAR(residual(0.008F, 0.008F), residual(0.0015F, 0.0015F), 1);
    EXPECT_GT(residual(0.008F, 0.0015F), 10);
  });
}

TEST(SurfaceAligner, RecoversKnownMotions) {
  onEachWidth([](ComputeContext& compute) {
    const AnalyticScene scene = roomCorner();
    Rig rig(compute);
    const Eigen::Isometry3d T_model = pose(3, 2, -1, 0.1, 0.0, -0.1);
    const SurfaceMaps model = mapsOf(compute, scene, kWorking, T_model);
    for (const Eigen::Isometry3d& motion :
         {pose(0, 0, 0, 0, 0, 0), pose(1, 0, 0, 0, 0, 0), pose(0, 2, 0, 0, 0, 0), pose(0, 0, 2, 0, 0, 0),
          pose(0, 0, 0, 0.02, 0, 0), pose(0, 0, 0, 0, 0.03, 0), pose(0, 0, 0, 0, 0, -0.04),
          pose(-1.5, 1, 2, 0.02, -0.01, 0.02)}) {
      const Eigen::Isometry3d truth = T_model * motion;
      const DepthPyramid& frame = rig.preprocessor->process(frameOf(scene, kKinect, truth));
      const PoseEstimate found = rig.track(frame, model, T_model);
      EXPECT_EQ(found.state, TrackingState::tracking) << found.inlier_fraction << ' ' << found.rmse_m;
      EXPECT_EQ(found.free_directions, 0);
      EXPECT_LT(translationBetween(found.T_world_camera, truth), 0.001);
      EXPECT_LT(degreesBetween(found.T_world_camera, truth), 0.05);
      EXPECT_GT(found.inlier_fraction, 0.8);
    }
  });
}

TEST(SurfaceAligner, IsDeterministic) {
  onEachWidth([](ComputeContext& compute) {
    const AnalyticScene scene = roomCorner();
    Rig rig(compute);
    const SurfaceMaps model = mapsOf(compute, scene, kWorking, Eigen::Isometry3d::Identity());
    const DepthPyramid& frame = rig.preprocessor->process(frameOf(scene, kKinect, pose(1, 1, 0, 0.01, 0, 0)));
    const PoseEstimate first = rig.track(frame, model, Eigen::Isometry3d::Identity());
    for (int i = 0; i < 5; ++i) {
      const PoseEstimate again = rig.track(frame, model, Eigen::Isometry3d::Identity());
      EXPECT_TRUE((again.T_world_camera.matrix().array() == first.T_world_camera.matrix().array()).all());
    }
  });
}

TEST(SurfaceAligner, DoesNotSlide_AlongAPlane) {
  onEachDevice([](ComputeContext& compute) {
    AnalyticScene scene;
    const Eigen::Vector3d normal = Eigen::Vector3d(0.3, 0.2, -1).normalized();
    scene.plane({0, 0, 1.5}, normal);
    Rig rig(compute);
    const SurfaceMaps model = mapsOf(compute, scene, kWorking, Eigen::Isometry3d::Identity());
    const Eigen::Isometry3d truth = pose(0.5, -0.5, 0, 0.01, 0.01, 0.02);
    const Eigen::Isometry3d prediction = truth * pose(0, 0, 0, 0.003, 0.002, 0.01);
    const PoseEstimate found =
        rig.track(rig.preprocessor->process(frameOf(scene, kKinect, truth)), model, prediction);
    EXPECT_EQ(found.free_directions, 3);
    EXPECT_EQ(found.state, TrackingState::uncertain);
    const Eigen::Vector3d moved = found.T_world_camera.translation() - prediction.translation();
    const Eigen::Vector3d error = found.T_world_camera.translation() - truth.translation();
    EXPECT_LT((moved - normal * normal.dot(moved)).norm(), 0.0005) << "slid in the plane";
    EXPECT_LT(std::abs(normal.dot(error)), 0.001) << "the plane's own direction is determined";
  });
}

TEST(SurfaceAligner, LeavesThreeDirectionsFree_OnANoisyPlane) {
  onEachDevice([](ComputeContext& compute) {
    AnalyticScene scene;
    scene.plane({0, 0, 1.5}, {0.1, 0.5, -1});
    Rig rig(compute);
    SurfaceMaps model = mapsOf(compute, scene, kWorking, Eigen::Isometry3d::Identity());
    std::mt19937 random(1);
    std::normal_distribution<float> tilt(0.0F, 0.035F);  // 2 degrees
    std::vector<cl_float4> normals = model.normals_world.read(compute.queue());
    for (cl_float4& n : normals) {
      Eigen::Vector3f tilted(n.s[0] + tilt(random), n.s[1] + tilt(random), n.s[2] + tilt(random));
      tilted.normalize();
      n = {{tilted.x(), tilted.y(), tilted.z(), 1}};
    }
    model.normals_world.write(compute.queue(), normals);
    RgbdFrame frame = frameOf(scene, kKinect, Eigen::Isometry3d::Identity());
    std::uniform_int_distribution<int> noise(-15, 15);  // of 0.2 mm
    for (int i = 0; i < 640 * 480; ++i) {
      auto& units = frame.depth.at<std::uint16_t>(i / 640, i % 640);
      if (units > 0) units = static_cast<std::uint16_t>(units + noise(random));
    }
    const Eigen::Isometry3d prediction = pose(0, 0, 0, 0.02, 0.01, 0);
    const PoseEstimate found = rig.track(rig.preprocessor->process(frame), model, prediction);
    EXPECT_EQ(found.free_directions, 3);
    EXPECT_FALSE(found.usable());
    EXPECT_NEAR(found.T_world_camera.translation().x(), 0.02, 0.002);
  });
}

TEST(SurfaceAligner, LeavesTwoDirectionsFree_OnACylinder) {
  onEachDevice([](ComputeContext& compute) {
    AnalyticScene scene;
    scene.cylinder({0, 0, 1.2}, {0, 1, 0}, 1.0);
    Rig rig(compute);
    const Eigen::Isometry3d T = pose(0, 0, 0, 0, 0, 0.9);
    const SurfaceMaps model = mapsOf(compute, scene, kWorking, T);
    const PoseEstimate found = rig.track(
        rig.preprocessor->process(frameOf(scene, kKinect, T * pose(0, 0, 0, 0.01, 0, 0))), model, T);
    EXPECT_EQ(found.free_directions, 2);
    EXPECT_EQ(found.state, TrackingState::uncertain);
  });
}

TEST(SurfaceAligner, IsLost_WithoutReadingsOrModel) {
  onEachDevice([](ComputeContext& compute) {
    const AnalyticScene scene = roomCorner();
    Rig rig(compute);
    const Eigen::Isometry3d prediction = pose(1, 2, 3, 0.1, 0.2, 0.3);
    RgbdFrame dark;
    dark.depth = cv::Mat::zeros(480, 640, CV_16UC1);
    const SurfaceMaps model = mapsOf(compute, scene, kWorking, Eigen::Isometry3d::Identity());
    EXPECT_EQ(rig.track(rig.preprocessor->process(dark), model, prediction).state, TrackingState::lost);

    const DepthPyramid& frame =
        rig.preprocessor->process(frameOf(scene, kKinect, Eigen::Isometry3d::Identity()));
    const SurfaceMaps empty_model = mapsOf(compute, AnalyticScene(), kWorking, Eigen::Isometry3d::Identity());
    EXPECT_EQ(rig.track(frame, empty_model, prediction).state, TrackingState::lost);
  });
}

TEST(SurfaceAligner, FindsNoPose_InAnotherScene) {
  onEachDevice([](ComputeContext& compute) {
    AnalyticScene other;
    other.sphere({0.2, 0.1, 2.2}, 0.9)
        .plane({0.8, 0, 0}, {-1, 0.3, 0})
        .cylinder({-0.6, 0, 1.4}, {1, 2, 0.3}, 0.3);
    const AnalyticScene scene = roomCorner();
    Rig rig(compute);
    const SurfaceMaps model = mapsOf(compute, scene, kWorking, Eigen::Isometry3d::Identity());
    for (const double turn_deg : {-10.0, 0.0, 15.0, 40.0}) {
      const DepthPyramid& frame =
          rig.preprocessor->process(frameOf(other, kKinect, pose(0, turn_deg, 0, 0, 0, 0)));
      for (const PoseEstimate& found :
           {rig.track(frame, model, Eigen::Isometry3d::Identity()), rig.search(frame, model)})
        EXPECT_FALSE(found.usable()) << turn_deg << ": inliers " << found.inlier_fraction << " rmse "
                                     << found.rmse_m;
    }
  });
}

TEST(SurfaceAligner, GivesNoWrongPose_AfterALargeMotion) {
  onEachDevice([](ComputeContext& compute) {
    const AnalyticScene scene = roomCorner();
    Rig rig(compute);
    const SurfaceMaps model = mapsOf(compute, scene, kWorking, Eigen::Isometry3d::Identity());
    for (const double turn_deg : {4.0, 6.0, 8.0, 12.0, 20.0, 30.0, 50.0}) {
      const Eigen::Isometry3d truth = pose(turn_deg / 3, turn_deg, -turn_deg / 2, 0.002 * turn_deg, 0, 0);
      const DepthPyramid& frame = rig.preprocessor->process(frameOf(scene, kKinect, truth));
      for (const PoseEstimate& found :
           {rig.track(frame, model, Eigen::Isometry3d::Identity()), rig.search(frame, model)}) {
        if (!found.usable()) continue;
        EXPECT_LT(translationBetween(found.T_world_camera, truth), 0.005) << turn_deg;
        EXPECT_LT(degreesBetween(found.T_world_camera, truth), 0.2) << turn_deg;
      }
    }
  });
}

}  // namespace
}  // namespace scantrove::test
