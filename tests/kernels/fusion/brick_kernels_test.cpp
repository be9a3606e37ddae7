#include <limits>
#include <random>

#include "core/compute/kernel_types.h"
#include "core/fusion/kernels/depth_tiles.h"
#include "embedded/fusion_kernels.h"
#include "tests/kernels/fusion/fusion_test_support.h"
#include "tests/reference/brick_reference.h"

namespace scantrove {
namespace {

using reference::DepthExtent;
using reference::TiledDepth;

constexpr int kTile = DEPTH_TILE;
constexpr float kMaxDepth_m = 5.0F;

/// A wall with a ball in front. The upper half has holes of every invalid value.
std::vector<float> depthWithHoles(const Intrinsics& K) {
  test::AnalyticScene scene;
  scene.plane({0, 0, 1.8}, {0.2, -0.3, -1}).sphere({0.1, 0, 1.2}, 0.3);
  std::vector<float> depth = scene.depth(K, Eigen::Isometry3d::Identity());
  const float none[] = {0.0F, -1.0F, 65.535F, std::numeric_limits<float>::quiet_NaN(),
                        std::numeric_limits<float>::infinity()};
  for (std::size_t i = 0; i < depth.size() / 2; i += 97) depth[i] = none[i / 97 % std::size(none)];
  return depth;
}

Kernel kernelOf(ComputeContext& compute, const char* name) {
  auto kernel = compute.kernel(kernels::fusion, name);
  EXPECT_TRUE(kernel) << kernel.error().message();
  return *kernel;
}

/// Extents of the tiles, on the device.
Buffer<cl_float2> reduce(ComputeContext& compute, const Intrinsics& K, const std::vector<float>& depth_m) {
  Buffer<cl_float> depth(compute.context(), depth_m.size());
  depth.write(compute.queue(), depth_m);
  const auto columns = static_cast<std::size_t>((K.width + kTile - 1) / kTile);
  const auto rows = static_cast<std::size_t>((K.height + kTile - 1) / kTile);
  Buffer<cl_float2> extents(compute.context(), columns * rows);
  kernelOf(compute, "reduce_depth_tiles")
      .launch(cl::NDRange(columns, rows), cl::NullRange, depth, cl_int{K.width}, cl_int{K.height},
              kMaxDepth_m, extents);
  return extents;
}

TEST(ReduceDepthTiles, MatchesTheFormula) {
  test::onEachDevice([](ComputeContext& compute) {
    for (const auto& [width, height] : {std::pair(317, 233), {16, 8}, {7, 3}, {1, 1}}) {
      const Intrinsics K{290,   288,   0.5F * static_cast<float>(width), 0.5F * static_cast<float>(height),
                         width, height};
      for (const bool is_empty : {false, true}) {
        std::vector<float> depth_m = depthWithHoles(K);
        if (is_empty) std::fill(depth_m.begin(), depth_m.end(), 0.0F);
        const TiledDepth reference(K, depth_m, double{kMaxDepth_m}, kTile);
        const std::vector<cl_float2> actual = reduce(compute, K, depth_m).read(compute.queue());
        const int columns = (width + kTile - 1) / kTile;
        for (std::size_t i = 0; i < actual.size(); ++i) {
          const int tile = static_cast<int>(i);
          const DepthExtent expected = reference.tile(tile % columns, tile / columns);
          ASSERT_EQ(double{actual[i].s[0]}, expected.smallest) << width << " tile " << i;
          ASSERT_EQ(double{actual[i].s[1]}, expected.largest) << width << " tile " << i;
        }
      }
    }
  });
}

TEST(FindBrickReadings, BoundsTheReadingsAndMatchesTheFormula) {
  test::onEachDevice([](ComputeContext& compute) {
    const Intrinsics K = test::oddCamera();
    const std::vector<float> depth_m = depthWithHoles(K);
    const TiledDepth reference(K, depth_m, double{kMaxDepth_m}, kTile);
    constexpr double kVoxel_m = 0.01;
    Eigen::Affine3d T_camera_window = Eigen::Affine3d::Identity();
    T_camera_window.linear() =
        kVoxel_m * Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
    T_camera_window.translation() << -1.3, -1.1, -0.2;
    // Bricks from behind the camera to beyond the wall, and outside the image on all sides.
    std::vector<cl_int4> bricks;
    for (int z = -4; z < 32; z += 2) {
      for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 40; ++x) bricks.push_back({{x, y, z, 0}});
      }
    }
    Eigen::Isometry3d kernel_T;
    kernel_T.matrix() = T_camera_window.matrix();
    Buffer<cl_int4> list(compute.context(), bricks.size());
    list.write(compute.queue(), bricks);
    Buffer<cl_float2> readings(compute.context(), bricks.size());
    kernelOf(compute, "find_brick_readings")
        .launch(cl::NDRange(bricks.size()), cl::NullRange, list, static_cast<cl_int>(bricks.size()),
                toKernel(kernel_T), toKernel(K.fx, K.fy, K.cx, K.cy), cl_int{K.width}, cl_int{K.height},
                reduce(compute, K, depth_m), kMaxDepth_m, readings);
    const std::vector<cl_float2> actual = readings.read(compute.queue());
    int compared = 0, seen = 0, complete = 0;
    for (std::size_t i = 0; i < bricks.size(); ++i) {
      const Eigen::Vector3i brick(bricks[i].s[0], bricks[i].s[1], bricks[i].s[2]);
      const DepthExtent touched = reference.touchedBy(brick, T_camera_window);
      ASSERT_LE(double{actual[i].s[0]}, touched.smallest) << brick.transpose();
      ASSERT_GE(double{actual[i].s[1]}, touched.largest) << brick.transpose();
      seen += touched.largest > 0 ? 1 : 0;
      const TiledDepth::Bounds expected = reference.boundsOf(brick, T_camera_window);
      if (!expected.decided) continue;
      ++compared;
      complete += expected.extent.smallest > 0 ? 1 : 0;
      ASSERT_EQ(double{actual[i].s[0]}, expected.extent.smallest) << brick.transpose();
      ASSERT_EQ(double{actual[i].s[1]}, expected.extent.largest) << brick.transpose();
    }
    EXPECT_GT(compared, static_cast<int>(bricks.size()) * 9 / 10);
    EXPECT_GT(seen, 2000);
    EXPECT_GT(complete, 100);
  });
}

}  // namespace
}  // namespace scantrove
