#pragma once
#include <memory>
#include <span>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/depth_pyramid.h"
#include "core/fusion/surface_maps.h"
#include "core/tracking/icp_pass.h"
#include "core/tracking/pose_judgment.h"

namespace scantrove {

/// Frame-to-model alignment: coarse-to-fine projective point-to-plane ICP with Huber weights, against the
/// map's surface raycast from some pose. Along directions that the geometry does not determine, the pose
/// stays as guessed. Never throws on a singular system; the outcome reports it. One thread, the context's.
class SurfaceAligner {
 public:
  [[nodiscard]] static Result<std::unique_ptr<SurfaceAligner>> create(ComputeContext& compute,
                                                                      float depth_noise_m);

  /// Aligns from the guess that fits best at the coarsest level, or from the first if the surface leaves
  /// directions free. `guesses` is not empty. The reprojection error of `landmarks` (may be null) is
  /// minimised together with the distance from the surface.
  [[nodiscard]] IcpOutcome align(const DepthPyramid& frame, const SurfaceMaps& model,
                                 std::span<const Eigen::Isometry3d> guesses,
                                 const SeenLandmarks* landmarks = nullptr) {
    return alignWith({landmarks, kSmallestEigenvalue}, frame, model, guesses);
  }
  /// Likewise, for guesses by a device that tracks itself: the surface moves them only along directions that
  /// it determines well (kFirmEigenvalue).
  [[nodiscard]] IcpOutcome alignFirmly(const DepthPyramid& frame, const SurfaceMaps& model,
                                       std::span<const Eigen::Isometry3d> guesses) {
    return alignWith({nullptr, kFirmEigenvalue}, frame, model, guesses);
  }
  /// Aligns from the best of several rotations of the camera at the model's pose: a hand's jerk is mostly
  /// rotation, and a lost camera often returns.
  [[nodiscard]] IcpOutcome alignTurned(const DepthPyramid& frame, const SurfaceMaps& model);

 private:
  /// Weighted mean squared cosine between the normals and a direction of motion, below which the direction is
  /// free. Rooms have 0.01 and more. On a desk seen from afar the pose began to drift at 0.003. On one plane
  /// the noise of the model's normals remains (0.0012 at 2 degrees).
  static constexpr double kSmallestEigenvalue = 0.004;

  /// What determines the pose beside the guess.
  struct Terms {
    const SeenLandmarks* landmarks;
    double smallest_eigenvalue;  ///< solveIcp
  };

  SurfaceAligner(IcpPass pass, float depth_noise_m) : pass_(std::move(pass)), depth_noise_m_(depth_noise_m) {}

  [[nodiscard]] IcpOutcome alignWith(const Terms& terms, const DepthPyramid& frame, const SurfaceMaps& model,
                                     std::span<const Eigen::Isometry3d> guesses);
  /// Passes at one level until the steps are small.
  [[nodiscard]] IcpOutcome descend(const DepthPyramid& frame, const SurfaceMaps& model,
                                   const Eigen::Isometry3d& guess, std::size_t level, const Terms& terms);
  /// The finer levels after the coarsest.
  [[nodiscard]] IcpOutcome refine(const DepthPyramid& frame, const SurfaceMaps& model, IcpOutcome coarse,
                                  std::size_t coarsest, const Terms& terms);

  IcpPass pass_;
  float depth_noise_m_;
};

}  // namespace scantrove
