#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/ids.h"
#include "core/capture/intrinsics.h"

namespace scantrove::reference {

/// Algorithms 1 and 2 of the thesis, literally: visits every voxel of a dense volume in every frame. The
/// volume starts at voxel `first`.
struct DenseLabelCloud {
  Eigen::Vector3i first;
  int side = 0;
  float voxel_size = 0;
  std::vector<std::uint32_t> labels = std::vector<std::uint32_t>();

  DenseLabelCloud(const Eigen::Vector3i& first_voxel, int voxels_a_side, float voxel_size_m)
      : first(first_voxel),
        side(voxels_a_side),
        voxel_size(voxel_size_m),
        labels(
            static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * static_cast<std::size_t>(side),
            0) {}

  [[nodiscard]] std::size_t indexOf(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(side) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(side) +
           static_cast<std::size_t>(x);
  }

  /// `vertices`: world, w = 0 if none. `merged`: S_cloud,t; pixels without fragment write nothing. distthresh
  /// of a pixel is at least `reach_of_depth` times the depth of its vertex.
  void update(const std::vector<Eigen::Vector4f>& vertices, const std::vector<FragmentId>& merged,
              const Intrinsics& K, const Eigen::Isometry3d& T_world_camera, float distthresh,
              float reach_of_depth = 0) {
    const Eigen::Matrix4f T_camera_world = T_world_camera.inverse().matrix().cast<float>();
    for (int z = 0; z < side; ++z) {
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const Eigen::Vector3f v_g = (first + Eigen::Vector3i(x, y, z)).cast<float>() * voxel_size +
                                      Eigen::Vector3f::Constant(0.5F * voxel_size);
          const Eigen::Vector3f v = (T_camera_world * v_g.homogeneous()).head<3>();
          if (v.z() <= 0) continue;
          const int column = static_cast<int>(std::floor(v.x() * K.fx / v.z() + K.cx + 0.5F));
          const int row = static_cast<int>(std::floor(v.y() * K.fy / v.z() + K.cy + 0.5F));
          if (column < 0 || row < 0 || column >= K.width || row >= K.height) continue;
          const auto pixel = static_cast<std::size_t>(row * K.width + column);
          if (vertices[pixel].w() == 0 || !merged[pixel]) continue;
          const float depth = (T_camera_world * vertices[pixel]).z();
          if ((vertices[pixel].head<3>() - v_g).norm() < std::max(distthresh, reach_of_depth * depth))
            labels[indexOf(x, y, z)] = merged[pixel].value;
        }
      }
    }
  }
};

}  // namespace scantrove::reference
