#pragma once
#include <vector>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_map.h"
#include "core/fusion/brick_window.h"
#include "core/fusion/depth_pyramid.h"
#include "core/fusion/fusion_params.h"

namespace scantrove {

/// Allocates the bricks for a depth image: all that touch the band of one truncation in front of and behind a
/// reading. The context's thread.
class BrickAllocator {
 public:
  [[nodiscard]] static Result<BrickAllocator> create(ComputeContext& compute, const FusionParams& params);

  /// Allocates into `map`, from images at least 16 pixels wide; `window` holds the pages of the frame's view.
  /// The order of slots depends only on the frame. Returns the number of new bricks.
  int allocate(BrickMap& map, const BrickWindow& window, const DepthPyramid& frame,
               const Eigen::Isometry3d& T_world_camera);

 private:
  BrickAllocator(ComputeContext& compute, const FusionParams& params) : compute_(&compute), params_(params) {}
  [[nodiscard]] std::vector<cl_int4> listMissing(const BrickMap& map, const BrickWindow& window,
                                                 const DepthPyramid& frame,
                                                 const Eigen::Isometry3d& T_world_camera,
                                                 const cl::NDRange& groups);

  ComputeContext* compute_;
  FusionParams params_;
  Kernel find_missing_bricks_;
  Kernel list_missing_bricks_;
  Buffer<cl_uchar> missing_;
  Buffer<cl_uint> seen_;
  Buffer<cl_int4> list_;
  Buffer<cl_int> count_;
};

}  // namespace scantrove
