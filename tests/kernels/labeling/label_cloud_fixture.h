#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/compute/device_choice.h"
#include "core/labeling/kernels/label_voxel.h"
#include "core/labeling/label_cloud.h"
#include "tests/reference/dense_label_cloud.h"
#include "tests/support/brick_contents.h"

namespace scantrove::test {

inline constexpr float kVoxel = 0.006F;
inline constexpr int kSide = 152;                                  // voxels of the dense volume: 0.912 m
inline const Eigen::Vector3i kFirst(-76, -76, -40);                // all axes include negative coordinates
inline const Intrinsics kCamera{110, 112, 52.3F, 41.1F, 107, 83};  // odd sizes

/// A sphere in front of a slanted plane, seen from `T`; every 17th pixel has no surface.
[[nodiscard]] inline std::vector<Eigen::Vector4f> renderScene(const Eigen::Isometry3d& T) {
  const Eigen::Vector3f center(0.02F, 0.01F, 0.12F);
  const float radius = 0.08F;
  const Eigen::Vector3f normal = Eigen::Vector3f(0.1F, -0.2F, -1).normalized();
  const float offset = normal.dot(Eigen::Vector3f(0, 0, 0.3F));
  const Eigen::Vector3f origin = T.translation().cast<float>();
  std::vector<Eigen::Vector4f> vertices;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const Eigen::Vector3f ray =
          T.linear().cast<float>() *
          kCamera.backProject(static_cast<float>(u), static_cast<float>(v), 1).normalized();
      float distance = (offset - normal.dot(origin)) / normal.dot(ray);
      const Eigen::Vector3f to_center = center - origin;
      const float along = to_center.dot(ray);
      const float miss = to_center.squaredNorm() - along * along;
      if (miss < radius * radius) distance = std::min(distance, along - std::sqrt(radius * radius - miss));
      const bool none = (u + v * kCamera.width) % 17 == 0 || !(distance > 0);
      const Eigen::Vector3f p = origin + distance * ray;
      vertices.push_back(none ? Eigen::Vector4f::Zero() : Eigen::Vector4f(p.x(), p.y(), p.z(), 1));
    }
  }
  return vertices;
}

/// The bricks within two voxels of a vertex: more than any update reaches.
[[nodiscard]] inline std::vector<Eigen::Vector3i> bricksNear(const std::vector<Eigen::Vector4f>& vertices) {
  std::set<std::array<int, 3>> near;
  for (const Eigen::Vector4f& vertex : vertices) {
    if (vertex.w() == 0) continue;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3f step(corner & 1 ? 2.0F : -2.0F, corner & 2 ? 2.0F : -2.0F,
                                 corner & 4 ? 2.0F : -2.0F);
      const Eigen::Vector3i at = ((vertex.head<3>() / kVoxel + step) / 8).array().floor().cast<int>();
      near.insert({at.x(), at.y(), at.z()});
    }
  }
  std::vector<Eigen::Vector3i> bricks;
  for (const auto& [x, y, z] : near) bricks.emplace_back(x, y, z);
  return bricks;
}

/// A label cloud and its map on one OpenCL device.
class LabelCloudTest : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    auto compute = ComputeContext::create({std::to_string(GetParam()), false});
    ASSERT_TRUE(compute) << compute.error().message();
    compute_ = std::move(*compute);
    auto cloud = LabelCloud::create(*compute_);
    ASSERT_TRUE(cloud) << cloud.error().message();
    cloud_ = std::move(*cloud);
    bricks_ = std::make_unique<BrickMap>(*compute_, kVoxel);
  }

  /// Allocates the bricks of the surface, as its integration does. Those that it adds lie outside the window,
  /// where a slower lookup finds them.
  SurfaceMaps toSurface(const std::vector<Eigen::Vector4f>& vertices, const Eigen::Isometry3d& T) {
    SurfaceMaps surface = inExistingBricks(vertices, T);
    bricks_->allocate(bricksNear(vertices));
    return surface;
  }
  SurfaceMaps inExistingBricks(const std::vector<Eigen::Vector4f>& vertices, const Eigen::Isometry3d& T) {
    SurfaceMaps surface;
    surface.K = kCamera;
    surface.T_world_camera = T;
    surface.vertices_world = Buffer<cl_float4>(compute_->context(), vertices.size());
    std::vector<cl_float4> values;
    for (const auto& v : vertices) values.push_back({{v.x(), v.y(), v.z(), v.w()}});
    surface.vertices_world.write(compute_->queue(), values);
    surface.window = windowOfAll(*compute_, *bricks_);
    return surface;
  }

  /// Labels of all voxels of the dense volume; `labeled` counts all labelled voxels of the map.
  std::vector<std::uint32_t> denseLabels(const reference::DenseLabelCloud& shape, std::size_t& labeled) {
    std::vector<std::uint32_t> dense(shape.labels.size(), 0);
    const std::vector<cl_uint> voxels = usedPart(*compute_, *bricks_, bricks_->pools().labels());
    labeled = 0;
    for (int slot = 0; slot < bricks_->brickCount(); ++slot) {
      for (int i = 0; i < BRICK_VOXELS; ++i) {
        const auto at = static_cast<std::size_t>(slot) * BRICK_VOXELS + static_cast<std::size_t>(i);
        const std::uint32_t label = LABEL_OF(voxels[at]);
        if (label == 0) continue;
        ++labeled;
        const Eigen::Vector3i voxel =
            8 * bricks_->device().positionOf(slot) + Eigen::Vector3i(i % 8, i / 8 % 8, i / 64) - shape.first;
        if ((voxel.array() < 0).any() || (voxel.array() >= shape.side).any()) continue;
        dense[shape.indexOf(voxel.x(), voxel.y(), voxel.z())] = label;
      }
    }
    return dense;
  }

  std::unique_ptr<ComputeContext> compute_;
  std::unique_ptr<LabelCloud> cloud_;
  std::unique_ptr<BrickMap> bricks_;
};

/// The parameter of LabelCloudTest: positions of the OpenCL devices.
[[nodiscard]] inline std::vector<int> allDevices() {
  std::vector<int> indices;
  for (const DeviceInfo& info : listDevices()) indices.push_back(info.index);
  return indices;
}

/// Patches that cycle through `fragments` fragments from `first` on; some pixels have none.
[[nodiscard]] inline std::vector<FragmentId> randomPatches(unsigned seed, std::uint32_t first,
                                                           std::uint32_t fragments = 20) {
  std::mt19937 random(seed);
  std::vector<FragmentId> patches;
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      const bool none = random() % 29 == 0;
      patches.push_back({none ? 0 : first + static_cast<std::uint32_t>(u / 11 + v / 9) % fragments});
    }
  }
  return patches;
}

[[nodiscard]] inline std::vector<FragmentId> onlyFragment(FragmentId fragment) {
  return std::vector<FragmentId>(static_cast<std::size_t>(kCamera.pixels()), fragment);
}

[[nodiscard]] inline Eigen::Isometry3d cameraAt(double x, double y, double yaw) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() = Eigen::Vector3d(x, y, -0.17);
  T.linear() =
      (Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(0.13, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  return T;
}

}  // namespace scantrove::test
