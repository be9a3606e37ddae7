#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/kernels/fusion/fusion_test_support.h"

namespace scantrove {
namespace {

using test::AnalyticScene;

// Depth is read at the nearest pixel. For voxels of a single view, on a slope of 45 degrees at 1.5 m, the
// error is up to half a pixel of 5 mm.
constexpr double kHalfPixelOfSlope_m = 0.0025;

struct Maps {
  std::vector<cl_float4> vertices;
  std::vector<cl_float4> normals;
};

Maps castFrom(ComputeContext& compute, DenseMap& map, const Eigen::Isometry3d& T, const Intrinsics& K) {
  SurfaceMaps surface;
  map.raycast(T, K, surface);
  EXPECT_EQ(surface.vertices_world.size(), static_cast<std::size_t>(K.pixels()));
  EXPECT_TRUE(surface.K == K);
  return {surface.vertices_world.read(compute.queue()), surface.normals_world.read(compute.queue())};
}

Eigen::Vector3d vectorOf(const cl_float4& v) { return {v.s[0], v.s[1], v.s[2]}; }

bool isWellFormed(const cl_float4& v) {
  return v.s[3] == 1.0F || (v.s[3] == 0.0F && v.s[0] == 0.0F && v.s[1] == 0.0F && v.s[2] == 0.0F);
}

struct Accuracy {
  int expected = 0;  ///< pixels with surface
  std::vector<double> distances_m;
  std::vector<double> angles_deg;
  double share(const std::vector<double>& of) const { return static_cast<double>(of.size()) / expected; }
};

// Compares with the truth, except near the image border and silhouettes (neighbours that differ by over 5
// cm).
Accuracy compare(const Maps& maps, const AnalyticScene& scene, const Eigen::Isometry3d& T,
                 const Intrinsics& K) {
  Accuracy result;
  const std::vector<float> depth = scene.depth(K, T);
  for (int v = 4; v < K.height - 4; ++v) {
    for (int u = 4; u < K.width - 4; ++u) {
      const auto i = static_cast<std::size_t>(v * K.width + u);
      bool smooth = depth[i] > 0.4F && depth[i] < 4.8F;
      for (int dv = -4; dv <= 4; ++dv) {
        for (int du = -4; du <= 4; ++du) {
          const float z = depth[static_cast<std::size_t>((v + dv) * K.width + u + du)];
          smooth = smooth && std::abs(z - depth[i]) < 0.05F;
        }
      }
      if (!smooth) continue;
      ++result.expected;
      if (maps.vertices[i].s[3] == 0.0F) continue;
      const Eigen::Vector3d truth =
          T * K.backProject(static_cast<float>(u), static_cast<float>(v), depth[i]).cast<double>();
      result.distances_m.push_back((vectorOf(maps.vertices[i]) - truth).norm());
      if (maps.normals[i].s[3] == 0.0F) continue;
      const Eigen::Vector3d normal = vectorOf(maps.normals[i]);
      EXPECT_NEAR(normal.norm(), 1.0, 1e-4);
      const double cosine = normal.dot(scene.seenBy(K, T, u, v)->normal);
      result.angles_deg.push_back(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / 3.14159265358979);
    }
  }
  std::sort(result.distances_m.begin(), result.distances_m.end());
  std::sort(result.angles_deg.begin(), result.angles_deg.end());
  return result;
}

double quantile(const std::vector<double>& sorted, double q) {
  return sorted[static_cast<std::size_t>(q * static_cast<double>(sorted.size() - 1))];
}

std::vector<Eigen::Isometry3d> posesAround() {
  return {test::lookAt({0, 0, -1.1}, {0, 0, 0}), test::lookAt({0.5, -0.3, -1.0}, {0, 0.05, 0}),
          test::lookAt({-0.5, 0.2, -0.9}, {0.05, 0, 0.1}, {1, 0.2, 0}),
          test::lookAt({-0.1, -0.6, -0.9}, {0, 0, 0})};
}

void fuse(ComputeContext& compute, DenseMap& map, const AnalyticScene& scene, const Intrinsics& K,
          const std::vector<Eigen::Isometry3d>& poses) {
  for (const Eigen::Isometry3d& T : poses) map.integrate(test::frameOf(compute, scene.depth(K, T), K), T);
}

TEST(Raycaster, FindsNothing_InAnEmptyMap) {
  test::onEachWidth([](ComputeContext& compute) {
    auto map = test::makeMap(compute);
    const Maps maps = castFrom(compute, *map, Eigen::Isometry3d::Identity(), test::oddCamera());
    for (std::size_t i = 0; i < maps.vertices.size(); ++i) {
      ASSERT_EQ(maps.vertices[i].s[3], 0.0F);
      ASSERT_EQ(maps.normals[i].s[3], 0.0F);
      ASSERT_TRUE(isWellFormed(maps.vertices[i]) && isWellFormed(maps.normals[i]));
    }
  });
}

TEST(Raycaster, PlaneIsWithinAMillimeter) {
  test::onEachWidth([](ComputeContext& compute) {
    AnalyticScene scene;
    scene.plane({0, 0, 0.3}, {0.3, -0.2, -1});
    const Intrinsics K = test::oddCamera();
    auto map = test::makeMap(compute);
    fuse(compute, *map, scene, K, posesAround());
    for (const Eigen::Isometry3d& T : posesAround()) {
      const Accuracy accuracy = compare(castFrom(compute, *map, T, K), scene, T, K);
      EXPECT_GT(accuracy.expected, 45000);
      EXPECT_GT(accuracy.share(accuracy.distances_m), 0.999);
      EXPECT_GT(accuracy.share(accuracy.angles_deg), 0.999);
      EXPECT_LT(quantile(accuracy.distances_m, 0.5), 0.0003);
      EXPECT_LT(quantile(accuracy.distances_m, 0.9), 0.001);
      EXPECT_LT(quantile(accuracy.distances_m, 0.99), kHalfPixelOfSlope_m);
      EXPECT_LT(quantile(accuracy.angles_deg, 0.5), 0.5);
      EXPECT_LT(quantile(accuracy.angles_deg, 0.99), 2.0);
    }
  });
}

TEST(Raycaster, SphereOnWallIsWithinAThirdOfAVoxel) {
  test::onEachWidth([](ComputeContext& compute) {
    AnalyticScene scene;
    scene.plane({0, 0, 0.3}, {0, 0, -1}).sphere({0.05, -0.03, 0}, 0.25);
    const Intrinsics K = test::oddCamera();
    const FusionParams params;
    auto map = test::makeMap(compute, params);
    fuse(compute, *map, scene, K, posesAround());
    for (const Eigen::Isometry3d& T : posesAround()) {
      const Accuracy accuracy = compare(castFrom(compute, *map, T, K), scene, T, K);
      EXPECT_GT(accuracy.share(accuracy.distances_m), 0.99);
      EXPECT_LT(quantile(accuracy.distances_m, 0.95), 0.3 * params.voxel_size_m);
      EXPECT_LT(quantile(accuracy.angles_deg, 0.5), 2.0);
      EXPECT_LT(quantile(accuracy.angles_deg, 0.95), 6.0);
    }
  });
}

// Segmentation uses normals from the first frame on.
TEST(Raycaster, NormalsOfOneNoisyFrameAreUsable) {
  test::onEachWidth([](ComputeContext& compute) {
    AnalyticScene scene;
    scene.plane({0, 0, 0.6}, {0.3, 0.4, -1}).sphere({0.1, 0, 0.3}, 0.3);
    const Intrinsics K{580, 580, 320, 240, 640, 480};
    const Intrinsics K_working = K.resizedTo(320, 240);
    const Eigen::Isometry3d T = test::lookAt({0, 0, -1.2}, {0, 0, 0});
    std::vector<float> depth = scene.depth(K, T);
    test::addDisparityNoise(depth, K, 3);
    auto map = test::makeMap(compute);
    map->integrate(test::frameOf(compute, depth, K), T);
    const Accuracy accuracy = compare(castFrom(compute, *map, T, K_working), scene, T, K_working);
    EXPECT_GT(accuracy.share(accuracy.angles_deg), 0.97);
    EXPECT_LT(quantile(accuracy.angles_deg, 0.5), 6.0);
    EXPECT_LT(quantile(accuracy.angles_deg, 0.9), 14.0);
  });
}

TEST(Raycaster, AgreesWithPlainRayMarching) {
  test::onEachWidth([](ComputeContext& compute) {
    AnalyticScene scene;
    scene.plane({0, 0, 0.3}, {0.1, 0.2, -1})
        .sphere({0.05, -0.03, 0}, 0.2)
        .box({-0.5, -0.2, -0.1}, {-0.3, 0.2, 0.2});
    const Intrinsics K{100, 100, 39.5F, 29.5F, 81, 61};
    const FusionParams params;
    auto map = test::makeMap(compute, params);
    fuse(compute, *map, scene, test::oddCamera(), posesAround());
    const test::HostVoxels voxels(compute, map->bricks());
    const reference::VoxelField field = voxels.field();
    const Eigen::Isometry3d T = test::lookAt({0.2, 0.1, -1.0}, {0, 0, 0});
    const Maps maps = castFrom(compute, *map, T, K);
    const double voxel_m = params.voxel_size_m;
    int both = 0;
    int one = 0;
    int different = 0;
    for (int v = 0; v < K.height; ++v) {
      for (int u = 0; u < K.width; ++u) {
        const cl_float4& vertex = maps.vertices[static_cast<std::size_t>(v * K.width + u)];
        ASSERT_TRUE(isWellFormed(vertex));
        const Eigen::Vector3d direction =
            T.linear() * K.backProject(static_cast<float>(u), static_cast<float>(v), 1.0F).cast<double>() /
            voxel_m;
        const Eigen::Vector3d origin = T.translation() / voxel_m;
        const auto t = reference::firstSurface(field, origin, direction, 0.05, params.max_depth_m);
        if (t.has_value() != (vertex.s[3] > 0)) ++one;
        if (!t || vertex.s[3] == 0) continue;
        ++both;
        different += (vectorOf(vertex) / voxel_m - (origin + *t * direction)).norm() > 0.1;
      }
    }
    // Both may differ at grazing surfaces and gaps, where steps fall on different sides.
    EXPECT_GT(both, 4000);
    EXPECT_LT(one, 0.02 * both);
    EXPECT_LT(different, 0.02 * both);
  });
}

TEST(Raycaster, FindsNoSurface_FromBehind) {
  test::onEachWidth([](ComputeContext& compute) {
    AnalyticScene scene;
    scene.plane({0, 0, 1}, {0, 0, -1});
    const Intrinsics K = test::oddCamera();
    auto map = test::makeMap(compute);
    fuse(compute, *map, scene, K, {Eigen::Isometry3d::Identity()});
    const Maps maps = castFrom(compute, *map, test::lookAt({0, 0, 2}, {0, 0, 0}), K);
    const auto seen = std::count_if(maps.vertices.begin(), maps.vertices.end(),
                                    [](const cl_float4& v) { return v.s[3] > 0; });
    EXPECT_EQ(seen, 0);
  });
}

TEST(Raycaster, IsUnaffected_ByDistantBricks) {
  test::onEachWidth([](ComputeContext& compute) {
    AnalyticScene scene;
    scene.plane({0, 0, 0.3}, {0.3, -0.2, -1}).sphere({0.05, -0.03, 0}, 0.2);
    const Intrinsics K = test::oddCamera();
    auto map = test::makeMap(compute);
    fuse(compute, *map, scene, K, posesAround());
    const Eigen::Isometry3d T = posesAround()[1];
    const Maps before = castFrom(compute, *map, T, K);
    // More bricks than the first pool holds, kilometres away on all sides.
    std::vector<Eigen::Vector3i> far_bricks;
    for (int i = 0; i < 30000; ++i)
      far_bricks.emplace_back((i % 2 ? 1 : -1) * (20000 + i), -30000 + 2 * i, 50000 - i);
    EXPECT_EQ(map->bricks().allocate(far_bricks), 30000);
    const Maps after = castFrom(compute, *map, T, K);
    EXPECT_EQ(std::memcmp(before.vertices.data(), after.vertices.data(),
                          before.vertices.size() * sizeof(cl_float4)),
              0);
    EXPECT_EQ(
        std::memcmp(before.normals.data(), after.normals.data(), before.normals.size() * sizeof(cl_float4)),
        0);
  });
}

TEST(Raycaster, IsAccurate_KilometersFromTheOrigin) {
  test::onEachWidth([](ComputeContext& compute) {
    const Eigen::Vector3d away(2000, -3000, 1500);
    AnalyticScene scene;
    scene.plane(away + Eigen::Vector3d(0, 0, 0.3), {0.3, -0.2, -1});
    const Intrinsics K = test::oddCamera();
    auto map = test::makeMap(compute);
    std::vector<Eigen::Isometry3d> poses = posesAround();
    for (Eigen::Isometry3d& T : poses) T.translation() += away;
    fuse(compute, *map, scene, K, poses);
    const Accuracy accuracy = compare(castFrom(compute, *map, poses[0], K), scene, poses[0], K);
    EXPECT_GT(accuracy.share(accuracy.distances_m), 0.999);
    // A float resolves 3000 m to 0.25 mm.
    EXPECT_LT(quantile(accuracy.distances_m, 0.9), 0.001);
    EXPECT_LT(quantile(accuracy.distances_m, 0.99), kHalfPixelOfSlope_m);
    EXPECT_LT(quantile(accuracy.angles_deg, 0.99), 2.0);
  });
}

}  // namespace
}  // namespace scantrove
