#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <unordered_set>

#include "core/capture/rgbd_frame.h"

namespace scantrove::test {

/// The true surface, sampled from exact depth images in cells of 1 cm.
class TrueSurface {
 public:
  /// Adds the readings of an exact frame at its true pose, for pixels whose instance passes `counts`.
  template <class Counts>
  void add(const RgbdFrame& frame, const Intrinsics& K, const Counts& counts) {
    for (int v = 0; v < frame.depth.rows; ++v) {
      for (int u = 0; u < frame.depth.cols; ++u) {
        const std::uint16_t units = frame.depth.at<std::uint16_t>(v, u);
        if (units == 0 || !counts(frame.instances.at<std::uint16_t>(v, u))) continue;
        const float z = static_cast<float>(units) * frame.meters_per_unit;
        const Eigen::Vector3f p = K.backProject(static_cast<float>(u), static_cast<float>(v), z);
        cells_.insert(keyOf(cellOf(*frame.T_world_camera * p.cast<double>())));
      }
    }
  }

  /// Whether a world point has surface within `reach` cells.
  [[nodiscard]] bool isNear(const Eigen::Vector3d& point, int reach) const {
    const Eigen::Vector3i cell = cellOf(point);
    for (int z = -reach; z <= reach; ++z) {
      for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
          const Eigen::Vector3i offset(x, y, z);
          if (offset.squaredNorm() <= reach * reach && cells_.contains(keyOf(cell + offset))) return true;
        }
      }
    }
    return false;
  }

 private:
  static Eigen::Vector3i cellOf(const Eigen::Vector3d& point) {
    return (point * 100).array().floor().cast<int>();
  }
  static std::int64_t keyOf(const Eigen::Vector3i& cell) {
    constexpr int kMiddle = 1 << 15;
    std::int64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) key = (key << 16) + cell[axis] + kMiddle;
    return key;
  }
  std::unordered_set<std::int64_t> cells_;
};

}  // namespace scantrove::test
