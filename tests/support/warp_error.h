#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/capture/frame_source.h"

namespace scantrove::test {

/// Depth of one frame seen from another.
struct WarpError {
  double error_m = 0;  ///< median of |depth in the other camera - depth that it measured|
  double depth_m = 0;  ///< median depth in the other camera
};

/// A frame with its camera.
struct PosedFrame {
  RgbdFrame frame;
  Intrinsics K;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

inline double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Moves each depth of `from` into the camera of `to` by K, unit and pose, and compares it with the depth
/// measured there. Small only where all three are right. Empty: fewer than 100 pixels meet.
inline std::optional<WarpError> warpError(const PosedFrame& from, const PosedFrame& to) {
  const Eigen::Isometry3f T = (to.T_world_camera.inverse() * from.T_world_camera).cast<float>();
  std::vector<double> errors, depths;
  for (int v = 0; v < from.frame.depth.rows; ++v) {
    for (int u = 0; u < from.frame.depth.cols; ++u) {
      const float z =
          static_cast<float>(from.frame.depth.at<std::uint16_t>(v, u)) * from.frame.meters_per_unit;
      if (z <= 0) continue;
      const Eigen::Vector3f p = T * from.K.backProject(static_cast<float>(u), static_cast<float>(v), z);
      if (p.z() < 0.05F) continue;
      const float x = std::round(to.K.fx * p.x() / p.z() + to.K.cx),
                  y = std::round(to.K.fy * p.y() / p.z() + to.K.cy);
      if (!(std::abs(x) < 1e4F && std::abs(y) < 1e4F)) continue;
      if (!to.K.isInside(static_cast<int>(x), static_cast<int>(y))) continue;
      const auto measured = to.frame.depth.at<std::uint16_t>(static_cast<int>(y), static_cast<int>(x));
      if (measured == 0) continue;
      errors.push_back(std::abs(static_cast<double>(measured) * to.frame.meters_per_unit - p.z()));
      depths.push_back(p.z());
    }
  }
  if (errors.size() < 100) return std::nullopt;
  return WarpError{medianOf(errors), medianOf(depths)};
}

/// The pose for a camera whose y and z axes point the other way.
inline Eigen::Isometry3d withFlippedAxes(const Eigen::Isometry3d& T_world_camera) {
  Eigen::Isometry3d flipped = T_world_camera;
  flipped.linear() = T_world_camera.linear() * Eigen::Vector3d(1, -1, -1).asDiagonal();
  return flipped;
}

}  // namespace scantrove::test
