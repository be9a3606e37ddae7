#pragma once
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_map.h"
#include "core/fusion/brick_window.h"
#include "core/fusion/depth_pyramid.h"
#include "core/fusion/fusion_params.h"

namespace scantrove {

/// Averages a depth image into bricks (Curless and Levoy 1996). One thread, the context's.
class Integrator {
 public:
  [[nodiscard]] static Result<Integrator> create(ComputeContext& compute, const FusionParams& params);

  /// Updates the voxels of `slots` (those in the frame's view). Skips bricks that are completely occluded.
  void integrate(BrickMap& map, const BrickWindow& window, std::span<const cl_int> slots,
                 const DepthPyramid& frame, const Eigen::Isometry3d& T_world_camera);

  /// The bricks of the last integrate() that contain only free space, both in its frame and in the map.
  /// Returns each once.
  [[nodiscard]] std::vector<Eigen::Vector3i> takeEmptyBricks();

 private:
  Integrator(ComputeContext& compute, const FusionParams& params) : compute_(&compute), params_(params) {}
  ComputeContext* compute_;
  FusionParams params_;
  Kernel reduce_depth_tiles_;
  Kernel find_brick_readings_;
  Kernel integrate_bricks_;
  Buffer<cl_float2> extents_;
  Buffer<cl_int4> bricks_;
  Buffer<cl_float2> readings_;
  Buffer<cl_uchar> empty_;
  Eigen::Vector3i first_brick_ = Eigen::Vector3i::Zero();  // of the window; host_bricks_ count from there
  std::vector<cl_int4> host_bricks_;
};

}  // namespace scantrove
