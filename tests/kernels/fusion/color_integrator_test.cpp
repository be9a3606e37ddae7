#include "core/fusion/color_integrator.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/fusion/kernels/color_voxel.h"
#include "tests/kernels/fusion/fusion_test_support.h"
#include "tests/reference/color_reference.h"
#include "tests/support/color_rig.h"

namespace scantrove {
namespace {

using test::ColorRig;
using test::ColorShot;
using test::PaintedScene;

FusionParams colorParams() {
  FusionParams params;
  params.voxel_size_m = 0.01F;
  return params;
}

Eigen::Vector3d rgbOf(cl_uint color) {
  return {static_cast<double>(COLOR_RED(color)), static_cast<double>(COLOR_GREEN(color)),
          static_cast<double>(COLOR_BLUE(color))};
}

PaintedScene paintedBallOnWall() {
  PaintedScene scene;
  scene.shape.plane({0, 0, 0.4}, {0.2, -0.1, -1}).sphere({-0.1, 0.1, 0.05}, 0.17);
  scene.paint = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(127 + 120 * std::sin(9 * p.x()), 127 + 120 * std::sin(11 * p.y()),
                           127 + 120 * std::sin(7 * p.z() + 3 * p.x()));
  };
  return scene;
}

PaintedScene wallAt(double z, const Eigen::Vector3d& rgb) {
  PaintedScene scene;
  scene.shape.plane({0, 0, z}, {0, 0, -1});
  scene.paint = [rgb](const Eigen::Vector3d&) { return rgb; };
  return scene;
}

/// A colour camera of another size beside the depth camera.
ColorCamera offsetColorCamera() {
  ColorCamera camera{{380.0F, 377.0F, 201.7F, 143.2F, 411, 301}, Eigen::Isometry3d::Identity()};
  camera.T_color_depth.translation() = Eigen::Vector3d(-0.03, 0.004, 0.002);
  camera.T_color_depth.linear() =
      Eigen::AngleAxisd(0.02, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  return camera;
}

std::vector<Eigen::Isometry3d> colorPoses() {
  return {test::lookAt({0, 0, -1.0}, {0, 0, 0}), test::lookAt({0.3, -0.2, -0.7}, {0, 0.05, 0}),
          test::lookAt({-0.35, 0.1, -0.8}, {0.05, 0, 0.1}, {1, 0.2, 0})};
}

reference::ColorView referenceView(ComputeContext& compute, const ColorShot& shot, const ColorCamera& camera,
                                   const FusionParams& params) {
  reference::ColorView view;
  view.K = shot.surface.K;
  view.T_world_camera = shot.surface.T_world_camera;
  view.K_color = camera.K;
  view.T_world_color = view.T_world_camera * camera.T_color_depth.inverse();
  view.image = shot.frame.color;
  view.voxel_size_m = params.voxel_size_m;
  view.depth_noise_m = params.depth_noise_m;
  const std::vector<cl_float4> normals = shot.surface.normals_world.read(compute.queue());
  const std::vector<cl_float4> readings = shot.depth.levels.front().vertices_camera.read(compute.queue());
  const auto vectorOf = [](const cl_float4& v) -> Eigen::Vector3d { return {v.s[0], v.s[1], v.s[2]}; };
  for (std::size_t i = 0; i < normals.size(); ++i) {
    view.vertices.emplace_back(shot.view.vertices_world[i].head<3>().cast<double>());
    view.normals.push_back(vectorOf(normals[i]));
    view.readings.push_back(vectorOf(readings[i]));
    view.is_surface.push_back(shot.view.vertices_world[i].w() > 0);
    view.has_normal.push_back(normals[i].s[3] > 0);
    view.has_reading.push_back(readings[i].s[3] > 0);
    view.is_hidden.push_back(shot.hidden.ptr<uchar>()[i] != 0);
  }
  return view;
}

/// Removes scattered readings and columns of readings.
void makeHoles(ComputeContext& compute, ColorShot& shot) {
  Buffer<cl_float4>& buffer = shot.depth.levels.front().vertices_camera;
  std::vector<cl_float4> readings = buffer.read(compute.queue());
  const auto width = static_cast<std::size_t>(shot.surface.K.width);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (i % 181 == 0 || i % width / 9 == 14) readings[i] = {};
  }
  buffer.write(compute.queue(), std::span<const cl_float4>(readings));
}

TEST(ColorIntegrator, EqualsTheFormula_InEveryVoxel) {
  test::onEachWidth([](ComputeContext& compute) {
    FusionParams params = colorParams();
    params.voxel_size_m = 0.012F;  // all bricks in every frame
    const PaintedScene scene = paintedBallOnWall();
    const Intrinsics K = test::oddCamera();
    ColorRig rig(compute, params);
    const BrickMap& map = rig.map().bricks();
    struct Expected {
      reference::ColorMean mean;
      bool decided = true;
    };
    std::map<std::size_t, Expected> expected;  // by voxel; slots do not change
    int views = 0;
    for (const bool registered : {false, true}) {
      for (const Eigen::Isometry3d& T : colorPoses()) {
        const ColorCamera camera =
            registered ? ColorCamera{K.resizedTo(2 * K.width, 2 * K.height), Eigen::Isometry3d::Identity()}
                       : offsetColorCamera();
        ColorShot shot = rig.observe(scene, K, T, registered ? std::nullopt : std::optional(camera),
                                     {camera.K.width, camera.K.height});
        makeHoles(compute, shot);
        const reference::ColorView view = referenceView(compute, shot, camera, params);
        const std::vector<test::HostVoxel> voxels = test::usedVoxels(compute, map);
        for (std::size_t i = 0; i < voxels.size(); ++i) {
          // Up to 1.5 voxels from the surface; the truncation is 4 voxels.
          if (voxels[i].weight == 0 || std::abs(voxels[i].distance) > 32767 * 1.5 / 4) continue;
          const Eigen::Vector3i local(static_cast<int>(i % 8), static_cast<int>(i / 8 % 8),
                                      static_cast<int>(i / 64 % 8));
          const Eigen::Vector3i voxel =
              8 * map.device().positionOf(static_cast<int>(i / BRICK_VOXELS)) + local;
          const auto answer =
              view.at((voxel.cast<double>().array() + 0.5) * static_cast<double>(params.voxel_size_m));
          Expected& of_voxel = expected[i];
          of_voxel.decided = of_voxel.decided && answer.decided;
          if (answer.seen) of_voxel.mean.add(*answer.seen, voxels[i].weight);
        }
        rig.paint(shot);
        ++views;
      }
    }
    const std::vector<cl_uint> colors = test::usedPart(compute, map, map.pools().colors());
    int compared = 0;
    int other_views = 0;
    int colored_elsewhere = 0;
    double worst = 0;
    double sum = 0;
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const auto found = expected.find(i);
      if (found == expected.end()) {
        colored_elsewhere += colors[i] != 0 ? 1 : 0;
        continue;
      }
      if (!found->second.decided) continue;
      const reference::ColorMean& mean = found->second.mean;
      if (mean.weight == 0 && colors[i] == 0) continue;
      ++compared;
      if (COLOR_WEIGHT(colors[i]) != static_cast<unsigned>(mean.weight)) {
        ++other_views;
        continue;
      }
      const double error = (rgbOf(colors[i]) - mean.rgb).cwiseAbs().maxCoeff();
      worst = std::max(worst, error);
      sum += error;
    }
    EXPECT_EQ(colored_elsewhere, 0);
    EXPECT_GT(compared, 10000);
    // A frame may skip bricks that the surface barely touches.
    EXPECT_LT(other_views, compared / 50);
    // Each mean is rounded to an integer level; later views reduce earlier rounding errors.
    EXPECT_LT(worst, 1.0 + 0.5 * (views - 1));
    EXPECT_LT(sum / compared, 1.0);
  });
}

TEST(ColorIntegrator, KeepsTheColor_OfOccludedSurface) {
  test::onEachWidth([](ComputeContext& compute) {
    const FusionParams params = colorParams();
    const Intrinsics K = test::oddCamera();
    const auto sides = [](const Eigen::Vector3d& p) {
      return p.z() > 0.9 ? Eigen::Vector3d(20, 200, 40) : Eigen::Vector3d(220, 30, 60);
    };
    PaintedScene wall{wallAt(1.2, Eigen::Vector3d::Zero()).shape, sides};
    PaintedScene with_board = wall;
    with_board.shape.box({-0.3, -0.3, 0.79}, {0.05, 0.3, 0.8});
    ColorRig rig(compute, params);
    const Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    const cv::Size size(K.width, K.height);
    for (int i = 0; i < 3; ++i) rig.show(wall, K, T, std::nullopt, size);
    for (int i = 0; i < 5; ++i) rig.show(with_board, K, T, offsetColorCamera(), size);
    const BrickMap& map = rig.map().bricks();
    const std::vector<cl_uint> colors = test::usedPart(compute, map, map.pools().colors());
    int of_wall = 0;
    int of_board = 0;
    for (std::size_t i = 0; i < colors.size(); ++i) {
      if (colors[i] == 0) continue;
      const double z = (map.device().positionOf(static_cast<int>(i / BRICK_VOXELS)).z() * 8 +
                        static_cast<int>(i / 64 % 8) + 0.5) *
                       0.01;
      const bool is_wall = z > 1;
      ++(is_wall ? of_wall : of_board);
      ASSERT_EQ(rgbOf(colors[i]), is_wall ? Eigen::Vector3d(20, 200, 40) : Eigen::Vector3d(220, 30, 60)) << z;
    }
    EXPECT_GT(of_wall, 20000);
    EXPECT_GT(of_board, 1000);
  });
}

TEST(ColorIntegrator, ColorsNoVoxel_WithoutDepthReading) {
  test::onEachWidth([](ComputeContext& compute) {
    const FusionParams params = colorParams();
    const Intrinsics K = test::oddCamera();
    ColorRig rig(compute, params);
    const Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    const PaintedScene wall = wallAt(1.0, {90, 90, 90});
    ColorShot shot = rig.observe(wall, K, T, std::nullopt, {K.width, K.height});
    // The left half has no readings, as behind a hand too near to measure; the map still shows the wall
    // there.
    std::vector<cl_float4> readings = shot.depth.levels.front().vertices_camera.read(compute.queue());
    for (int i = 0; i < K.pixels(); ++i) {
      if (i % K.width < 150) readings[static_cast<std::size_t>(i)] = {};
    }
    shot.depth.levels.front().vertices_camera.write(compute.queue(), std::span<const cl_float4>(readings));
    rig.paint(shot);
    const BrickMap& map = rig.map().bricks();
    const std::vector<cl_uint> colors = test::usedPart(compute, map, map.pools().colors());
    int colored = 0;
    for (std::size_t i = 0; i < colors.size(); ++i) {
      if (colors[i] == 0) continue;
      ++colored;
      const double x = (map.device().positionOf(static_cast<int>(i / BRICK_VOXELS)).x() * 8 +
                        static_cast<int>(i % 8) + 0.5) *
                       0.01;
      ASSERT_GE(K.fx * x / 1.02 + K.cx, 150 - 1);
    }
    EXPECT_GT(colored, 5000);
  });
}

/// The colour of the voxel straight ahead at depth z.
Eigen::Vector3d aheadAt(ComputeContext& compute, const BrickMap& map, double z_m) {
  const int z = static_cast<int>(std::floor(z_m / 0.01));
  const std::vector<cl_uint> colors = test::usedPart(compute, map, map.pools().colors());
  const int slot = map.device().slotOf({0, 0, z / 8});
  EXPECT_NE(slot, BRICK_NONE);
  const cl_uint color =
      colors[static_cast<std::size_t>(slot) * BRICK_VOXELS + static_cast<std::size_t>(64 * (z % 8))];
  EXPECT_NE(color, 0U);
  return rgbOf(color);
}

TEST(ColorIntegrator, FollowsSmallChanges_AtFullWeight) {
  test::onEachWidth([](ComputeContext& compute) {
    const Intrinsics K = test::oddCamera();
    ColorRig rig(compute, colorParams());
    const cv::Size size(K.width, K.height);
    const double z = 1.7;
    ColorShot shot;
    for (int i = 0; i < 40; ++i) {
      shot = rig.observe(wallAt(z, {100, 50, 200}), K, Eigen::Isometry3d::Identity(), std::nullopt, size);
      rig.paint(shot);
    }
    EXPECT_EQ(aheadAt(compute, rig.map().bricks(), z), Eigen::Vector3d(100, 50, 200))
        << "a constant colour is stable";
    // Each step is a twentieth of three levels; rounding to the nearest level would never change the mean.
    shot.frame.color.setTo(cv::Scalar(203, 53, 97));
    for (int i = 0; i < 200; ++i) rig.paint(shot);
    const Eigen::Vector3d after = aheadAt(compute, rig.map().bricks(), z);
    EXPECT_LE((after - Eigen::Vector3d(97, 53, 203)).cwiseAbs().maxCoeff(), 1);
  });
}

TEST(ColorIntegrator, NearViewsOutweighFarOnes) {
  test::onEachWidth([](ComputeContext& compute) {
    const Intrinsics K = test::oddCamera();
    ColorRig rig(compute, colorParams());
    const cv::Size size(K.width, K.height);
    const auto from = [](double z) {
      Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
      T.translation().z() = z;
      return T;
    };
    const PaintedScene near_view = wallAt(1.0, {200, 100, 0});
    const PaintedScene far_view = wallAt(1.0, {0, 100, 200});
    for (int i = 0; i < 4; ++i) rig.show(far_view, K, from(-0.9), std::nullopt, size);
    for (int i = 0; i < 4; ++i) rig.show(near_view, K, from(0.3), std::nullopt, size);
    // Weights are 32 / 3.61 and 32 / 0.49, rounded: 4 views of 9 against 4 of 64.
    EXPECT_LT(
        (aheadAt(compute, rig.map().bricks(), 1.0) - Eigen::Vector3d(175, 100, 25)).cwiseAbs().maxCoeff(), 3);
    for (int i = 0; i < 4; ++i) rig.show(far_view, K, from(-0.9), std::nullopt, size);
    EXPECT_GT(aheadAt(compute, rig.map().bricks(), 1.0).x(), 145) << "far views do not replace near colour";
  });
}

TEST(ColorIntegrator, ColorsNothing_WithoutColorImage) {
  test::onEachWidth([](ComputeContext& compute) {
    const Intrinsics K = test::oddCamera();
    ColorRig rig(compute, colorParams());
    ColorShot shot = rig.observe(wallAt(1, {9, 9, 9}), K, Eigen::Isometry3d::Identity(), std::nullopt,
                                 {K.width, K.height});
    shot.frame.color.release();
    rig.paint(shot);
    const BrickMap& map = rig.map().bricks();
    const std::vector<cl_uint> colors = test::usedPart(compute, map, map.pools().colors());
    EXPECT_EQ(std::ranges::count(colors, 0U), std::ssize(colors));
  });
}

TEST(ColorIntegrator, ColorsALargeView_OverSeveralFrames) {
  test::onEachWidth([](ComputeContext& compute) {
    const Intrinsics K = test::oddCamera();
    FusionParams params = colorParams();
    params.voxel_size_m = 0.005F;
    ColorRig rig(compute, params);
    const ColorShot shot = rig.observe(wallAt(2.002, {60, 70, 80}), K, Eigen::Isometry3d::Identity(),
                                       std::nullopt, {K.width, K.height});
    const BrickMap& map = rig.map().bricks();
    const auto coloredBricks = [&] {
      const std::vector<cl_uint> colors = test::usedPart(compute, map, map.pools().colors());
      std::size_t count = 0;
      for (std::size_t i = 0; i < colors.size(); i += BRICK_VOXELS) {
        count +=
            std::any_of(&colors[i], &colors[i] + BRICK_VOXELS, [](cl_uint c) { return c != 0; }) ? 1U : 0U;
      }
      return count;
    };
    rig.paint(shot);
    const std::size_t at_first = coloredBricks();
    // Turns differ in their number of bricks.
    EXPECT_LT(at_first, ColorIntegrator::kBricksAtATime * 11 / 10);
    EXPECT_GT(at_first, ColorIntegrator::kBricksAtATime / 3);
    for (int i = 0; i < 15; ++i) rig.paint(shot);
    // 2.2 m x 1.6 m in squares of 4 cm, without the border pixels.
    EXPECT_GT(coloredBricks(), 2000U);
  });
}

}  // namespace
}  // namespace scantrove
