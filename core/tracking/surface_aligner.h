#pragma once
#include <memory>
#include <optional>
#include <utility>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/depth_pyramid.h"
#include "core/fusion/fusion_params.h"
#include "core/fusion/icp_pass.h"
#include "core/fusion/pose_estimate.h"
#include "core/fusion/pose_judgement.h"
#include "core/fusion/surface_maps.h"

namespace scantrove {

/// Frame-to-model tracking: coarse-to-fine projective point-to-plane ICP with Huber weights against the map's
/// surface as raycast from the last good pose; motion along directions that the geometry does not determine
/// is not changed from the prediction. Never throws on a singular system: it returns a state. One thread, the
/// context's.
class Tracker {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Tracker>> create(ComputeContext& compute,
                                                               const FusionParams& params);

  /// Pose of `frame`, starting from `prediction`. An uncertain pose is remembered as one more start for the
  /// next call, so that a camera is followed in front of one model until it may be trusted again.
  [[nodiscard]] PoseEstimate track(const DepthPyramid& frame, const SurfaceMaps& model,
                                   const Eigen::Isometry3d& prediction);

 private:
  Tracker(IcpPass pass, float depth_noise_m) : pass_(std::move(pass)), depth_noise_m_(depth_noise_m) {}

  /// Passes at one level until the steps are small.
  [[nodiscard]] IcpOutcome descend(const DepthPyramid& frame, const SurfaceMaps& model,
                                   const Eigen::Isometry3d& guess, std::size_t level);
  /// Aligns the coarsest level from the prediction, from the model's own pose (a camera that stopped) and
  /// from the last uncertain pose (a camera on its way back); the best of them.
  [[nodiscard]] IcpOutcome descendFromBestGuess(const DepthPyramid& frame, const SurfaceMaps& model,
                                                const Eigen::Isometry3d& prediction, std::size_t coarsest);
  /// The finer levels after the coarsest, and the verdict.
  [[nodiscard]] PoseEstimate finish(const DepthPyramid& frame, const SurfaceMaps& model,
                                    const IcpOutcome& coarse, std::size_t coarsest, bool searched);
  /// The best of several turns of the camera at the model's pose: a hand's jerk is mostly rotation, and a
  /// camera that was lost often comes back.
  [[nodiscard]] IcpOutcome search(const DepthPyramid& frame, const SurfaceMaps& model, std::size_t coarsest);

  IcpPass pass_;
  float depth_noise_m_;
  std::optional<Eigen::Isometry3d>
      last_uncertain_;  ///< of the frame before, when it was not trusted but not lost
};

}  // namespace scantrove
