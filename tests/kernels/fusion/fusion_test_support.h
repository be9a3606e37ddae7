#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <vector>

#include "core/fusion/dense_map.h"
#include "tests/reference/ray_march_reference.h"
#include "tests/support/analytic_scene.h"
#include "tests/support/brick_contents.h"
#include "tests/support/each_device.h"

namespace scantrove::test {

[[nodiscard]] inline std::unique_ptr<DenseMap> makeMap(ComputeContext& compute,
                                                       const FusionParams& params = {}) {
  auto map = DenseMap::create(compute, params);
  EXPECT_TRUE(map) << map.error().message();
  return std::move(*map);
}

[[nodiscard]] inline DepthPyramid frameOf(ComputeContext& compute, const std::vector<float>& depth_m,
                                          const Intrinsics& K) {
  DepthPyramid frame;
  frame.K = K;
  frame.depth_m = Buffer<cl_float>(compute.context(), depth_m.size());
  frame.depth_m.write(compute.queue(), std::span<const float>(depth_m));
  return frame;
}

/// A camera with an image of odd size.
[[nodiscard]] inline Intrinsics oddCamera() { return {290.0F, 288.0F, 157.3F, 118.1F, 317, 233}; }

/// All voxels of a map on the host.
class HostVoxels {
 public:
  HostVoxels(ComputeContext& compute, const BrickMap& map) : map_(map), voxels_(usedVoxels(compute, map)) {}

  /// The voxel as stored, or null where there is no brick.
  [[nodiscard]] const HostVoxel* find(const Eigen::Vector3i& voxel) const {
    const Eigen::Vector3i brick(voxel.x() >> BRICK_SHIFT, voxel.y() >> BRICK_SHIFT, voxel.z() >> BRICK_SHIFT);
    const int slot = map_.device().slotOf(brick);
    if (slot == BRICK_NONE) return nullptr;
    const Eigen::Vector3i local = voxel - BRICK_SIDE * brick;
    const int index = local.x() + BRICK_SIDE * (local.y() + BRICK_SIDE * local.z());
    return &voxels_[static_cast<std::size_t>(slot) * BRICK_VOXELS + static_cast<std::size_t>(index)];
  }

  [[nodiscard]] reference::VoxelField field() const {
    return [this](const Eigen::Vector3i& voxel) -> std::optional<double> {
      const HostVoxel* found = find(voxel);
      if (found == nullptr || found->weight == 0) return std::nullopt;
      return found->distance / 32767.0;
    };
  }

  [[nodiscard]] const std::vector<HostVoxel>& all() const { return voxels_; }

 private:
  const BrickMap& map_;
  std::vector<HostVoxel> voxels_;
};

}  // namespace scantrove::test
