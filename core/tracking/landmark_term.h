#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "core/capture/intrinsics.h"

namespace scantrove {

/// Landmarks nearer to the colour camera than this are left out: no camera measures depth there, and small
/// errors in depth move their pixels far.
inline constexpr float kNearestLandmark_m = 0.1F;

/// Landmarks in a colour image, with their pixels.
struct SeenLandmarks {
  Intrinsics K;
  Eigen::Isometry3d T_color_depth = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Vector3d> points_world;
  std::vector<Eigen::Vector2d> pixels;

  /// Adds landmarks of the same image.
  void append(const SeenLandmarks& others);
  /// Number of the image's 8 x 6 cells that contain a landmark: how far they are spread.
  [[nodiscard]] int cells() const;
  /// Median reprojection error when the depth camera is at `T_world_depth`; infinite without landmarks.
  [[nodiscard]] double errorPx(const Eigen::Isometry3d& T_world_depth) const;
};

/// The normal equations J x = r of the landmarks' reprojection, for the same twist as IcpSystem's. Rows are
/// the two components of (pixel - projection) z / fx, metres at the landmark, weighted by 1 / z^2 and by
/// Huber.
struct LandmarkTerm {
  Eigen::Matrix<double, 6, 6> JtJ = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> Jtr = Eigen::Matrix<double, 6, 1>::Zero();
  double weight = 0;  ///< trace of the translational part of JtJ

  /// About `center` (world), for a depth camera at `T_world_depth`.
  [[nodiscard]] static LandmarkTerm of(const SeenLandmarks& seen, const Eigen::Isometry3d& T_world_depth,
                                       const Eigen::Vector3d& center);
};

}  // namespace scantrove
