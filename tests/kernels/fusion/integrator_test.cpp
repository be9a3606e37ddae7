#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "tests/kernels/fusion/fusion_test_support.h"
#include "tests/reference/brick_reference.h"
#include "tests/reference/dense_tsdf_reference.h"

namespace scantrove {
namespace {

using test::AnalyticScene;

FusionParams coarse() {
  FusionParams params;
  params.voxel_size_m = 0.01F;
  return params;
}

AnalyticScene ballOnWall() {
  AnalyticScene scene;
  scene.plane({0, 0, 0.4}, {0.2, -0.1, -1}).sphere({-0.1, 0.1, 0.05}, 0.17);
  return scene;
}

// Poses around the origin, so that brick coordinates are negative and positive.
std::vector<Eigen::Isometry3d> poses() {
  return {test::lookAt({0, 0, -1.0}, {0, 0, 0}), test::lookAt({0.3, -0.2, -0.9}, {0, 0.05, 0}),
          test::lookAt({-0.35, 0.1, -0.8}, {0.05, 0, 0.1}, {1, 0.2, 0})};
}

TEST(Integrator, EqualsTheDenseVolume_InEveryVoxel) {
  test::onEachWidth([](ComputeContext& compute) {
    const FusionParams params = coarse();
    const Intrinsics K = test::oddCamera();
    const double truncation_m = params.truncation_vox * params.voxel_size_m;
    const Eigen::Vector3i first(-48, -48, -32);
    const Eigen::Vector3i size(96, 96, 80);
    reference::DenseTsdf dense(first, size, params.voxel_size_m, truncation_m, params.max_weight);
    auto map = test::makeMap(compute, params);
    int frames = 0;
    for (const Eigen::Isometry3d& T : poses()) {
      std::vector<float> depth = ballOnWall().depth(K, T);
      test::addDisparityNoise(depth, K, 1);
      for (std::size_t i = 0; i < depth.size(); i += 37) depth[i] = 0;
      map->integrate(test::frameOf(compute, depth, K), T);
      // Bricks allocated later lack earlier frames; only voxels of equal weight are compared.
      dense.integrate(depth, K, T, params.max_depth_m);
      ++frames;
    }
    // Each average is rounded by at most half of 1/32767 of a truncation. Float depths and transforms add
    // 1e-5 truncations.
    const double tolerance = 0.5 * frames / 32767.0 + 2e-4;
    const test::HostVoxels voxels(compute, map->bricks());
    int compared = 0;
    int unequal = 0;
    int missed = 0;
    for (int z = 0; z < size.z(); ++z) {
      for (int y = 0; y < size.y(); ++y) {
        for (int x = 0; x < size.x(); ++x) {
          const Eigen::Vector3i voxel = first + Eigen::Vector3i(x, y, z);
          const reference::DenseTsdf::Voxel& expected = dense.at(voxel);
          const test::HostVoxel* found = voxels.find(voxel);
          if (found == nullptr) {
            // Only free space may lack a brick.
            missed += expected.weight > 0 && expected.distance < 0.99 && !expected.doubtful;
            continue;
          }
          if (expected.doubtful || found->weight != static_cast<int>(expected.weight)) {
            missed += !expected.doubtful && found->weight > expected.weight;
            continue;
          }
          ++compared;
          unequal += std::abs(found->distance / 32767.0 - expected.distance) > tolerance;
        }
      }
    }
    EXPECT_GT(compared, 40000);
    EXPECT_EQ(unequal, 0);
    EXPECT_EQ(missed, 0);
  });
}

TEST(Integrator, CountsObservationsUpToTheLargestWeight) {
  test::onEachWidth([](ComputeContext& compute) {
    FusionParams params = coarse();
    params.max_weight = 5;
    const Intrinsics K = test::oddCamera();
    AnalyticScene scene;
    scene.plane({0, 0, 1}, {0, 0, -1});
    auto map = test::makeMap(compute, params);
    const DepthPyramid frame = test::frameOf(compute, scene.depth(K, Eigen::Isometry3d::Identity()), K);
    for (int i = 1; i <= 8; ++i) {
      map->integrate(frame, Eigen::Isometry3d::Identity());
      const test::HostVoxels voxels(compute, map->bricks());
      const test::HostVoxel* voxel = voxels.find({0, 0, 99});
      ASSERT_NE(voxel, nullptr);
      EXPECT_EQ(voxel->weight, std::min(i, 5));
      EXPECT_NEAR(voxel->distance, 32767 * (1.0 - 0.995) / 0.04, 5);
    }
  });
}

TEST(Integrator, AllocatesTheBricksThatTheBandTouches) {
  test::onEachWidth([](ComputeContext& compute) {
    const FusionParams params = coarse();
    const Intrinsics K = test::oddCamera();
    const double truncation_m = params.truncation_vox * params.voxel_size_m;
    const double brick_m = 8 * static_cast<double>(params.voxel_size_m);
    auto map = test::makeMap(compute, params);
    reference::TouchedBricks expected;
    // Later frames find most bricks allocated.
    for (const Eigen::Isometry3d& T : poses()) {
      std::vector<float> depth = ballOnWall().depth(K, T);
      for (std::size_t i = 0; i < depth.size(); i += 3) depth[i] = 0;
      map->integrate(test::frameOf(compute, depth, K), T);
      for (int v = 0; v < K.height; ++v) {
        for (int u = 0; u < K.width; ++u) {
          const float z = depth[static_cast<std::size_t>(v * K.width + u)];
          if (!(z >= params.min_depth_m && z <= params.max_depth_m)) continue;
          const Eigen::Vector3d ray =
              K.backProject(static_cast<float>(u), static_cast<float>(v), 1.0F).cast<double>();
          expected.add(T * (ray * (z - truncation_m)) / brick_m, T * (ray * (z + truncation_m)) / brick_m);
        }
      }
      int missing = 0;
      for (const auto& [x, y, z] : expected.certain) {
        missing += map->bricks().device().slotOf({x, y, z}) == BRICK_NONE ? 1 : 0;
      }
      EXPECT_EQ(missing, 0);
      int unneeded = 0;
      for (int slot = 0; slot < map->bricks().brickCount(); ++slot) {
        const Eigen::Vector3i& b = map->bricks().device().positionOf(slot);
        const reference::TouchedBricks::Brick brick{b.x(), b.y(), b.z()};
        unneeded += expected.certain.contains(brick) || expected.possible.contains(brick) ? 0 : 1;
      }
      EXPECT_EQ(unneeded, 0);
    }
    EXPECT_GT(expected.certain.size(), 1000U);
  });
}

TEST(Integrator, IgnoresInvalidReadings) {
  test::onEachWidth([](ComputeContext& compute) {
    const Intrinsics K = test::oddCamera();
    auto map = test::makeMap(compute);
    std::vector<float> depth(static_cast<std::size_t>(K.pixels()), 0.0F);
    map->integrate(test::frameOf(compute, depth, K), Eigen::Isometry3d::Identity());
    EXPECT_EQ(map->bricks().brickCount(), 0);
    const float none[] = {0.0F,
                          65.535F,
                          -1.0F,
                          1e30F,
                          std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity(),
                          0.1F};
    for (std::size_t i = 0; i < depth.size(); ++i) depth[i] = none[i % std::size(none)];
    map->integrate(test::frameOf(compute, depth, K), Eigen::Isometry3d::Identity());
    EXPECT_EQ(map->bricks().brickCount(), 0);

    // Existing bricks are not changed either.
    const std::vector<float> wall(depth.size(), 1.0F);
    map->integrate(test::frameOf(compute, wall, K), Eigen::Isometry3d::Identity());
    const test::HostVoxels before(compute, map->bricks());
    for (float& z : depth) z = z == 0.1F ? 0.0F : z;
    map->integrate(test::frameOf(compute, depth, K), Eigen::Isometry3d::Identity());
    const test::HostVoxels after(compute, map->bricks());
    EXPECT_FALSE(before.all().empty());
    EXPECT_EQ(before.all(), after.all());
  });
}

TEST(Integrator, ClearsSurface_WhenSeenThrough) {
  test::onEachWidth([](ComputeContext& compute) {
    const Intrinsics K = test::oddCamera();
    auto map = test::makeMap(compute, coarse());
    const std::vector<float> near_wall(static_cast<std::size_t>(K.pixels()), 0.8F);
    const std::vector<float> far_wall(static_cast<std::size_t>(K.pixels()), 1.6F);
    map->integrate(test::frameOf(compute, near_wall, K), Eigen::Isometry3d::Identity());
    for (int i = 0; i < 8; ++i)
      map->integrate(test::frameOf(compute, far_wall, K), Eigen::Isometry3d::Identity());
    const test::HostVoxels voxels(compute, map->bricks());
    const test::HostVoxel* behind_near_wall = voxels.find({0, 0, 82});
    ASSERT_NE(behind_near_wall, nullptr);
    EXPECT_GT(behind_near_wall->distance, 0);
  });
}

// A wall disappears and returns: its bricks are inactive meanwhile, and it reappears at its old position.
TEST(Integrator, DeactivatesFreeBricks_UntilSurfaceReturns) {
  test::onEachWidth([](ComputeContext& compute) {
    const Intrinsics K = test::oddCamera();
    const FusionParams params = coarse();
    auto map = test::makeMap(compute, params);
    const BrickMap& bricks = map->bricks();
    const auto integrateWall = [&](float wall_m, int times) {
      const std::vector<float> depth(static_cast<std::size_t>(K.pixels()), wall_m);
      for (int i = 0; i < times; ++i)
        map->integrate(test::frameOf(compute, depth, K), Eigen::Isometry3d::Identity());
    };
    const auto depthInTheMiddle = [&] {
      SurfaceMaps maps;
      map->raycast(Eigen::Isometry3d::Identity(), K, maps);
      return maps.vertices_world
          .read(compute.queue())[static_cast<std::size_t>(K.height / 2 * K.width + K.width / 2)]
          .s[2];
    };
    integrateWall(0.8F, 1);
    const int bricks_of_near_wall = bricks.brickCount();
    EXPECT_EQ(bricks.inactiveCount(), 0);
    EXPECT_NEAR(depthInTheMiddle(), 0.8, 0.001);

    // One reading at -1 and n at +1 average to (n - 1) / (n + 1). The third exceeds half a truncation, and
    // the next frame deactivates the bricks, except those partly outside the image.
    integrateWall(1.6F, 4);
    EXPECT_GT(bricks.inactiveCount(), bricks_of_near_wall / 2);
    EXPECT_NEAR(depthInTheMiddle(), 1.6, 0.001);

    integrateWall(0.8F, 1);
    EXPECT_EQ(bricks.inactiveCount(), 0);
    integrateWall(0.8F, 20);
    EXPECT_NEAR(depthInTheMiddle(), 0.8, 0.01);
  });
}

TEST(Integrator, IsDeterministic) {
  test::onEachWidth([](ComputeContext& compute) {
    const Intrinsics K = test::oddCamera();
    std::vector<test::HostVoxel> results[2];
    std::vector<Eigen::Vector3i> bricks[2];
    for (int run = 0; run < 2; ++run) {
      auto map = test::makeMap(compute);
      for (const Eigen::Isometry3d& T : poses()) {
        map->integrate(test::frameOf(compute, ballOnWall().depth(K, T), K), T);
      }
      for (int slot = 0; slot < map->bricks().brickCount(); ++slot)
        bricks[run].push_back(map->bricks().device().positionOf(slot));
      results[run] = test::usedVoxels(compute, map->bricks());
      results[run].resize(bricks[run].size() * BRICK_VOXELS);
    }
    EXPECT_EQ(bricks[0], bricks[1]);
    EXPECT_EQ(results[0], results[1]);
  });
}

}  // namespace
}  // namespace scantrove
