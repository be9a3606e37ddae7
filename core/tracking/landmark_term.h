#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "core/capture/intrinsics.h"

namespace scantrove {

/// Landmarks nearer to the colour camera than this are left out: no camera has depth there, and the least
/// error in depth moves their pixels far.
inline constexpr float kNearestLandmark_m = 0.1F;

/// Landmarks that a colour image shows, and where.
struct SeenLandmarks {
  Intrinsics K;
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Vector3d> points_world;
  std::vector<Eigen::Vector2d> pixels;

  /// Adds those of the same image.
  void append(const SeenLandmarks& others);
  /// How much of the image they are spread over: how many of its 8 x 6 cells hold one.
  [[nodiscard]] int cells() const;
  /// Median distance of the pixels from where a depth camera at `T_world_depth` would see the landmarks.
  [[nodiscard]] double errorPx(const Eigen::Isometry3d& T_world_depth) const;
};

/// The normal equations of their reprojection, J x = r, for the same twist as IcpSystem's. Rows are the two
/// components of (pixel - projection) z / fx, metres at the landmark, weighted by 1 / z^2 and by Huber.
struct LandmarkTerm {
  Eigen::Matrix<double, 6, 6> JtJ = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> Jtr = Eigen::Matrix<double, 6, 1>::Zero();
  double weight = 0;  ///< trace of the translational part of JtJ

  /// About `centre` (world), for a depth camera at `T_world_depth`.
  [[nodiscard]] static LandmarkTerm of(const SeenLandmarks& seen, const Eigen::Isometry3d& T_world_depth,
                                       const Eigen::Vector3d& center);
};

}  // namespace scantrove
