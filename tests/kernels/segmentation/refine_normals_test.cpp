#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "core/segmentation/kernels/window_layout.h"
#include "core/segmentation/normal_refiner.h"
#include "tests/reference/plane_scene.h"
#include "tests/reference/refine_normals_reference.h"
#include "tests/support/each_device.h"

namespace scantrove {
namespace {

using reference::toEigen;

constexpr int kRadius_px = WINDOW_RADIUS;

std::vector<cl_float4> refine(ComputeContext& compute, const Intrinsics& K,
                              const Eigen::Isometry3d& T_world_camera,
                              const std::vector<cl_float4>& vertices_world,
                              const SegmentationParams& params) {
  Result<NormalRefiner> refiner = NormalRefiner::create(compute);
  EXPECT_TRUE(refiner) << refiner.error().message();
  SurfaceMaps surface;
  surface.K = K;
  surface.T_world_camera = T_world_camera;
  surface.vertices_world = Buffer<cl_float4>(compute.context(), vertices_world.size());
  surface.vertices_world.write(compute.queue(), vertices_world);
  return refiner->refine(surface, params).read(compute.queue());
}

TEST(RefineNormals, AreExactOnPlanesAndValleysAndSmoothOnRidges) {
  const Intrinsics K{260, 260, 31.5F, 23.5F, 64, 48};
  test::onEachWidth([&](ComputeContext& compute) {
    for (const bool convex : {false, true}) {
      const reference::RenderedFaces scene = reference::render(reference::wedge(convex, 0.8), K);
      const std::vector<cl_float4> normals =
          refine(compute, K, Eigen::Isometry3d::Identity(), scene.vertices, {});
      for (int y = 0; y < K.height; ++y) {
        for (int x = 0; x < K.width; ++x) {
          const auto i = static_cast<std::size_t>(y * K.width + x);
          ASSERT_EQ(normals[i].s[3], 1.0F);
          // 0.2 degrees, from float vertices at 1 m (rounded to 6e-8 m) and windows of about 15 mm.
          const double turn_rad =
              std::acos(std::min(1.0, toEigen(normals[i]).dot(toEigen(scene.normals[i]))));
          const bool at_crease = x >= 32 - kRadius_px && x < 32 + kRadius_px;
          if (!convex || !at_crease) {
            ASSERT_LT(turn_rad, 0.0035) << x << ", " << y;
          } else if (x == 31 || x == 32) {
            ASSERT_GT(turn_rad, 0.1);
          }
        }
      }
    }
  });
}

TEST(RefineNormals, EqualsTheFormula) {
  const Intrinsics K{260, 262, 157.2F, 118.4F, 317, 233};
  const Eigen::Isometry3d T_world_camera =
      Eigen::Translation3d(1, -2, 0.5) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  const Eigen::Isometry3d T_camera_world = T_world_camera.inverse();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> noise(-1, 1);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<cl_float4> vertices;
  std::vector<double> z;
  for (int v = 0; v < K.height; ++v) {
    for (int u = 0; u < K.width; ++u) {
      const double depth_m = 0.9 + 0.002 * std::abs((u + v / 2) % 60 - 30) + 0.4 * ((u / 70 + v / 60) % 2) +
                             0.001 * noise(random);
      const Eigen::Vector3d p =
          T_world_camera *
          (K.backProject(static_cast<float>(u), static_cast<float>(v), 1.0F).cast<double>() * depth_m);
      vertices.push_back(
          {{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 1}});
      if (random() % 15 == 0) vertices.back() = {{0, 0, 0, 0}};
      if (random() % 50 == 0) vertices.back() = {{nan, nan, nan, random() % 2 == 0 ? 1.0F : nan}};
      const bool valid = vertices.back().s[3] > 0 && toEigen(vertices.back()).allFinite();
      z.push_back(valid ? (T_camera_world * toEigen(vertices.back())).z() : 0);
    }
  }
  const SegmentationParams params;
  const reference::NormalReference reference(K, z, kRadius_px, params.normal_gate_m);
  test::onEachWidth([&](ComputeContext& compute) {
    const std::vector<cl_float4> normals = refine(compute, K, T_world_camera, vertices, params);
    int own = 0, moved = 0;
    for (int y = 0; y < K.height; ++y) {
      for (int x = 0; x < K.width; ++x) {
        const auto i = static_cast<std::size_t>(y * K.width + x);
        if (!(z[i] > 0)) {
          ASSERT_EQ(normals[i].s[3], 0.0F);
          continue;
        }
        const reference::WindowPlane& center = reference.plane(x, y);
        std::vector<reference::WindowPlane> windows;
        double margin = center.margin, best = 1e9;
        for (int dy = -kRadius_px; dy <= kRadius_px; ++dy) {
          for (int dx = -kRadius_px; dx <= kRadius_px; ++dx) {
            if (!reference.sameSurface(x, y, x + dx, y + dy)) continue;
            windows.push_back(reference.plane(x + dx, y + dy));
            margin = std::min(margin, windows.back().margin);
            if (windows.back().fits) best = std::min(best, windows.back().rms_m);
          }
        }
        if (margin < 1e-3) continue;  // a reading lies on the gate within float rounding
        ASSERT_EQ(normals[i].s[3] > 0, best < 1e8);
        if (best > 1e8) continue;
        const Eigen::Vector3d normal_camera = T_camera_world.linear() * toEigen(normals[i]);
        const bool may_keep = center.fits && center.concavity_m < params.concave_from_m + 1e-5;
        const bool may_move = !center.fits || center.concavity_m > params.concave_from_m - 1e-5;
        // With 1 mm of noise, float moments give the direction to 1e-3. Windows whose rms differs by less
        // than 5 um are interchangeable.
        bool found = may_keep && (normal_camera - center.normal).norm() < 2e-3;
        own += found ? 1 : 0;
        for (const reference::WindowPlane& window : windows) {
          if (found || !may_move || !window.fits || window.rms_m > best + 5e-6) continue;
          found = (normal_camera - window.normal).norm() < 2e-3;
          moved += found ? 1 : 0;
        }
        ASSERT_TRUE(found) << x << ", " << y << " concavity " << center.concavity_m;
      }
    }
    EXPECT_GT(own, 5000);
    EXPECT_GT(moved, 5000);
  });
}

TEST(RefineNormals, HasNoNormals_InAnEmptyFrame) {
  test::onEachWidth([](ComputeContext& compute) {
    const Intrinsics K{100, 100, 8, 6, 17, 13};
    const std::vector<cl_float4> no_surface(17 * 13, cl_float4{{0, 0, 0, 0}});
    for (const cl_float4& n : refine(compute, K, Eigen::Isometry3d::Identity(), no_surface, {})) {
      for (const float value : n.s) EXPECT_EQ(value, 0.0F);
    }
  });
}

}  // namespace
}  // namespace scantrove
