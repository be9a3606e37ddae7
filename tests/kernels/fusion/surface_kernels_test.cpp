#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "core/compute/kernel_types.h"
#include "embedded/fusion_kernels.h"
#include "tests/reference/surface_reference.h"
#include "tests/support/each_device.h"

namespace scantrove {
namespace {

using reference::InverseDepthPlane;
using reference::SurfaceReference;
using test::onEachWidth;

constexpr int kPad = 4;
constexpr float kNoPlane = 1e30F;
// Float rounding may decide otherwise for neighbours this close to the slope limit (relative), or planes this
// close in cost.
constexpr double kUndecided = 1e-3;

/// Images of the kernels: rows of 16 ceil(width / 16) pixels, with a border of kPad.
struct PaddedImage {
  int width, height, stride;
  PaddedImage(int w, int h) : width(w), height(h), stride((w + 15) / 16 * 16 + 2 * kPad) {}
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(stride * (height + 2 * kPad)); }
  [[nodiscard]] std::size_t at(int u, int v) const {
    return static_cast<std::size_t>((v + kPad) * stride + u + kPad);
  }
  /// Planes have four rows per image row: a, b, c and the error.
  [[nodiscard]] std::size_t plane(int u, int v, int row) const {
    return static_cast<std::size_t>((4 * (v + kPad) + row) * stride + u + kPad);
  }
};

Intrinsics cameraOf(int width, int height) {
  return {290.0F, 288.0F, 0.47F * static_cast<float>(width), 0.52F * static_cast<float>(height),
          width,  height};
}

/// A ridge, a valley, steps and noise, with holes of 0, NaN and 65.535 m.
std::vector<float> roughDepth(const Intrinsics& K, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<float> depth;
  for (int v = 0; v < K.height; ++v) {
    for (int u = 0; u < K.width; ++u) {
      double z = 1.2 + 0.004 * std::abs(u - K.width / 2) - 0.003 * std::abs(v - K.height / 3);
      if (u > 3 * K.width / 4) z += 0.5;
      z += 0.0008 * z * z * noise(random);
      const double chance = uniform(random);
      depth.push_back(chance < 0.04   ? 0.0F
                      : chance < 0.05 ? std::numeric_limits<float>::quiet_NaN()
                      : chance < 0.06 ? 65.535F
                                      : static_cast<float>(z));
    }
  }
  return depth;
}

struct Case {
  Intrinsics K;
  std::vector<float> depth;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto& [width, height] : {std::pair(97, 61), {64, 5}, {3, 70}, {1, 1}}) {
    const Intrinsics K = cameraOf(width, height);
    all.push_back({K, roughDepth(K, static_cast<unsigned>(width))});
  }
  Intrinsics tall_pixels = cameraOf(97, 61);
  tall_pixels.fy /= 2;
  all.push_back({tall_pixels, roughDepth(tall_pixels, 5)});
  const Intrinsics K = cameraOf(33, 9);
  all.push_back({K, std::vector<float>(static_cast<std::size_t>(K.pixels()), 0.0F)});  // an empty frame
  all.push_back({K, std::vector<float>(static_cast<std::size_t>(K.pixels()),
                                       0.0F)});  // a frame with one line of readings
  for (int u = 0; u < K.width; ++u) all.back().depth[static_cast<std::size_t>(4 * K.width + u)] = 1.5F;
  return all;
}

/// 1 / depth; 0 without reading.
Buffer<cl_float> inversePadded(ComputeContext& compute, const Case& c) {
  const PaddedImage image(c.K.width, c.K.height);
  std::vector<float> values(image.size(), 0.0F);
  for (int v = 0; v < c.K.height; ++v) {
    for (int u = 0; u < c.K.width; ++u) {
      const float depth = c.depth[static_cast<std::size_t>(v * c.K.width + u)];
      values[image.at(u, v)] = depth == 0 ? 0 : 1 / depth;
    }
  }
  Buffer<cl_float> buffer(compute.context(), values.size());
  buffer.write(compute.queue(), values);
  return buffer;
}

cl::NDRange itemsOf(const ComputeContext& compute, const Intrinsics& K) {
  return compute.lanes().overRows(K.width, K.height);
}

TEST(FitPlanes, MatchesTheFormula) {
  onEachWidth([](ComputeContext& compute) {
    auto kernel = compute.kernel(kernels::fusion, "fit_planes");
    ASSERT_TRUE(kernel) << kernel.error().message();
    int fitted = 0;
    int undecided = 0;
    for (const Case& c : cases()) {
      SCOPED_TRACE(c.K.width);
      const PaddedImage image(c.K.width, c.K.height);
      Buffer<cl_float> planes(compute.context(), 4 * image.size());
      planes.fill(compute.queue(), kNoPlane);
      kernel->launch(itemsOf(compute, c.K), compute.lanes().rowGroup(), inversePadded(compute, c),
                     cl_int{c.K.width}, cl_int{c.K.height}, cl_float2{{c.K.fx, c.K.fy}}, planes);
      const std::vector<float> actual = planes.read(compute.queue());
      const SurfaceReference reference(c.K, c.depth, {});
      for (int v = 0; v < c.K.height; ++v) {
        for (int u = 0; u < c.K.width; ++u) {
          const InverseDepthPlane expected = reference.plane(u, v);
          if (expected.margin < kUndecided) {
            ++undecided;
            continue;
          }
          const float error = actual[image.plane(u, v, 3)];
          ASSERT_EQ(error < kNoPlane, expected.fits) << u << ' ' << v;
          if (!expected.fits) continue;
          ++fitted;
          // Inverse depths of about 1 are rounded to 6e-8; the sums use their differences.
          ASSERT_NEAR(actual[image.plane(u, v, 0)], expected.a, 1e-6) << u << ' ' << v;
          ASSERT_NEAR(actual[image.plane(u, v, 1)], expected.b, 1e-6) << u << ' ' << v;
          ASSERT_NEAR(actual[image.plane(u, v, 2)], expected.c, 1e-6) << u << ' ' << v;
          // The error is the difference of two sums of at most 1e-3, each accurate to 1e-7.
          ASSERT_NEAR(error, expected.error, 1e-10 + 1e-3 * expected.error) << u << ' ' << v;
        }
      }
    }
    EXPECT_GT(fitted, 4500);
    EXPECT_LT(undecided, fitted / 10);
  });
}

TEST(OrientSurface, MatchesTheFormula) {
  onEachWidth([](ComputeContext& compute) {
    auto kernel = compute.kernel(kernels::fusion, "orient_surface");
    ASSERT_TRUE(kernel) << kernel.error().message();
    constexpr float kVoxel_m = 0.006F;
    const Eigen::Vector3d origin_m(-3.3, 120.75, 0.5);                    // of the window, in the world
    Eigen::Isometry3d T_window_camera_m = Eigen::Isometry3d::Identity();  // metres to metres
    T_window_camera_m.linear() =
        Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
    T_window_camera_m.translation() << 1.1, 2.2, 0.7;
    Eigen::Isometry3d T_window_camera = T_window_camera_m;  // metres to voxels
    T_window_camera.matrix().topRows<3>() /= static_cast<double>(kVoxel_m);
    int oriented = 0;
    int undecided = 0;
    for (const Case& c : cases()) {
      SCOPED_TRACE(c.K.width);
      const SurfaceReference reference(c.K, c.depth, {});
      const PaddedImage image(c.K.width, c.K.height);
      std::vector<InverseDepthPlane> fitted;
      std::vector<float> values(4 * image.size(), kNoPlane);
      for (int v = 0; v < c.K.height; ++v) {
        for (int u = 0; u < c.K.width; ++u) {
          const InverseDepthPlane plane = reference.plane(u, v);
          fitted.push_back(plane);
          values[image.plane(u, v, 0)] = static_cast<float>(plane.a);
          values[image.plane(u, v, 1)] = static_cast<float>(plane.b);
          values[image.plane(u, v, 2)] = static_cast<float>(plane.c);
          values[image.plane(u, v, 3)] = plane.fits ? static_cast<float>(plane.error) : kNoPlane;
        }
      }
      Buffer<cl_float> planes(compute.context(), values.size());
      planes.write(compute.queue(), values);
      const auto pixels = static_cast<std::size_t>(c.K.pixels());
      Buffer<cl_float4> vertices(compute.context(), pixels), normals(compute.context(), pixels);
      kernel->launch(itemsOf(compute, c.K), compute.lanes().rowGroup(), inversePadded(compute, c), planes,
                     cl_int{c.K.width}, cl_int{c.K.height}, toKernel(c.K.fx, c.K.fy, c.K.cx, c.K.cy),
                     toKernel(T_window_camera), kVoxel_m,
                     toKernel(static_cast<float>(origin_m.x()), static_cast<float>(origin_m.y()),
                              static_cast<float>(origin_m.z()), 0.0F),
                     vertices, normals);
      const auto actual_v = vertices.read(compute.queue());
      const auto actual_n = normals.read(compute.queue());
      const Eigen::Isometry3d T_world_camera = Eigen::Translation3d(origin_m) * T_window_camera_m;
      for (int v = 0; v < c.K.height; ++v) {
        for (int u = 0; u < c.K.width; ++u) {
          const std::size_t i = reference.index(u, v);
          const Eigen::Vector4d vertex = reference.vertex(u, v, T_world_camera);
          const SurfaceReference::Normal normal = reference.normal(u, v, fitted, T_world_camera.linear());
          if (normal.margin < kUndecided) ++undecided;
          if (normal.normal.w() > 0) ++oriented;
          for (Eigen::Index k = 0; k < 4; ++k) {
            const auto component = static_cast<std::size_t>(k);
            // A float resolves 120 m, and 65 m from there, to 8e-6 m.
            ASSERT_NEAR(actual_v[i].s[component], vertex[k], 3e-5) << u << ' ' << v;
            if (normal.margin < kUndecided) continue;
            ASSERT_NEAR(actual_n[i].s[component], normal.normal[k], 2e-5) << u << ' ' << v;
          }
        }
      }
    }
    EXPECT_GT(oriented, 4500);
    EXPECT_LT(undecided, oriented / 20);
  });
}

}  // namespace
}  // namespace scantrove
