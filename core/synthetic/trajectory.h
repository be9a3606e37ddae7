#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <span>

namespace scantrove::synthetic {

/// Where a camera is and what the middle of its image shows. World frame, metres.
struct Gaze {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
};

/// A camera's way, for any time from 0 on.
using CameraPath = std::function<Gaze(double time_s)>;

/// Uniform cubic B-spline through the neighbourhood of the points, one a `period_s`, forth and back for ever.
[[nodiscard]] Gaze alongSpline(std::span<const Gaze> points, double period_s, double time_s);

/// A camera on its way in somebody's hand.
class Trajectory {
 public:
  /// `seed` makes the tremor; without tremor the way is the same for every seed.
  Trajectory(CameraPath path, bool tremor, std::uint32_t seed);
  /// T_world_camera: x right, y down, z forward.
  [[nodiscard]] Eigen::Isometry3d pose(double time_s) const;

 private:
  CameraPath path_;
  bool tremor_;
  std::uint32_t seed_;
};

}  // namespace scantrove::synthetic
