#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

#include "core/tracking/landmark_term.h"

namespace scantrove {

/// The normal equations of one pass of point-to-plane ICP, J x = r, for the twist x = (rotation, translation)
/// about `centre`: a world point p moves to centre + exp(rotation) (p - centre) + translation. Host side; any
/// thread.
struct IcpSystem {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  Matrix6 JtJ = Matrix6::Zero();
  Vector6 Jtr = Vector6::Zero();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< world; the mean of the associated points
  double radius_m = 0;  ///< root mean square distance of the associated points from `centre`
  double weight = 0;    ///< trace of the translational part of JtJ = sum of the weights
  /// Root mean square residual, with outliers limited and far readings weighted by their noise.
  double fit_residual_m = 0;
  double squared_error = 0;  ///< sum r^2, m^2
  int inliers = 0;           ///< pixels associated
  int overlap = 0;           ///< pixels with depth that meet a surface of the model
  int before = 0;            ///< of these, pixels far in front of it: something new may have appeared
  int behind = 0;            ///< pixels far behind it: the surface would have to be transparent
  int readings = 0;          ///< pixels with depth

  /// Adds the groups' sums (ICP_SUMS floats each, icp_layout.h) in double and in order, and moves the
  /// equations from `kernel_center` to the mean of the points.
  [[nodiscard]] static IcpSystem fromSums(std::span<const float> sums, const Eigen::Vector3d& kernel_center);
};

/// Smallest eigenvalue (see solveIcp) at which the surface determines the pose well; below it landmarks or
/// the device's poses are used. There the pose slides with errors that all readings share (lens, calibration,
/// voxels). On a desk seen from afar the pose began to drift at 0.012. In a kitchen seen again, at 0.016 -
/// 0.02, it was up to 20 mm off.
inline constexpr double kFirmEigenvalue = 0.02;

/// The least-squares motion of an IcpSystem.
struct IcpStep {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();  ///< T_new = motion * T_old
  double rotation_rad = 0;
  double translation_m = 0;  ///< of the centre
  bool is_firm = false;      ///< the surface alone determines all directions well (kFirmEigenvalue)
  int free_directions = 0;   ///< directions left at zero because the geometry does not determine them
  /// False: nothing was associated, or the sums are not finite; `motion` is the identity.
  bool finite = false;

  /// A part of this step, `share` in 0..1. `center`: IcpSystem::center.
  [[nodiscard]] IcpStep part(double share, const Eigen::Vector3d& center) const;
};

/// Solves by eigen-decomposition of JtJ / weight, with rotations in units of radius_m. Along eigenvectors
/// with an eigenvalue under `smallest_eigenvalue` (mean squared cosine between normals and direction) the
/// solution is zero, so that the pose stays as predicted (solution remapping, Zhang, Kaess and Singh 2016).
/// `landmarks` (about the same centre; may be null) are minimised together with the surface and outweigh it.
/// Never fails: see IcpStep::finite.
[[nodiscard]] IcpStep solveIcp(const IcpSystem& system, double smallest_eigenvalue,
                               const LandmarkTerm* landmarks = nullptr);

}  // namespace scantrove
