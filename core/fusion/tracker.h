#pragma once
#include <memory>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/depth_pyramid.h"
#include "core/fusion/pose_estimate.h"
#include "core/fusion/surface_maps.h"

namespace scantrove {

/// Frame-to-model tracking: coarse-to-fine projective point-to-plane ICP with Huber weights against the map's
/// surface as raycast from the last good pose; motion along directions that the geometry does not determine
/// is not changed from the prediction. Never throws on a singular system: it returns a state. One thread, the
/// context's.
class Tracker {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Tracker>> create(ComputeContext& compute);
  ~Tracker();

  /// Pose of `frame`, starting from `prediction`. An uncertain pose is remembered as one more start for the
  /// next call, so that a camera is followed in front of one model until it may be trusted again.
  [[nodiscard]] PoseEstimate track(const DepthPyramid& frame, const SurfaceMaps& model,
                                   const Eigen::Isometry3d& prediction);

 private:
  Tracker() = default;
  class Machinery;
  std::unique_ptr<Machinery> machinery_;
};

}  // namespace scantrove
