#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <span>

namespace scantrove::synthetic {

/// Eye and target (centre of the image). World frame, metres.
struct Gaze {
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();
  Eigen::Vector3d target = Eigen::Vector3d::Zero();
};

/// A camera path, defined for any time from 0 on.
using CameraPath = std::function<Gaze(double time_s)>;

/// Uniform cubic B-spline that approximates the points, one per `period_s`, back and forth forever.
[[nodiscard]] Gaze alongSpline(std::span<const Gaze> points, double period_s, double time_s);

/// A hand-held camera on a path.
class Trajectory {
 public:
  /// `seed` affects only the tremor; without tremor all seeds give the same path.
  Trajectory(CameraPath path, bool tremor, std::uint32_t seed);
  /// T_world_camera: x right, y down, z forward.
  [[nodiscard]] Eigen::Isometry3d pose(double time_s) const;

 private:
  CameraPath path_;
  bool tremor_;
  std::uint32_t seed_;
};

}  // namespace scantrove::synthetic
