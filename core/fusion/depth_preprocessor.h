#pragma once
#include <memory>
#include <vector>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/compute/compute_context.h"
#include "core/fusion/depth_plane.h"
#include "core/fusion/depth_pyramid.h"
#include "core/fusion/fusion_params.h"

namespace scantrove {

/// The camera of the working views of a depth camera: at most `working_width` pixels wide.
[[nodiscard]] Intrinsics workingCameraOf(const Intrinsics& K, int working_width);

/// Converts depth to metres, applies the edge-preserving filter, and builds the pyramid of vertex and normal
/// maps. Image sizes are those of the recording; each frame may have its own intrinsics. Readings of low
/// confidence are removed first. The context's thread.
class DepthPreprocessor {
 public:
  [[nodiscard]] static Result<std::unique_ptr<DepthPreprocessor>> create(ComputeContext& compute,
                                                                         const Intrinsics& K,
                                                                         const FusionParams& params);

  /// The result of the last process().
  [[nodiscard]] const DepthPyramid& pyramid() const { return pyramid_; }

  /// Depths outside [min_depth, max_depth] become 0. The result is valid until the next call.
  [[nodiscard]] const DepthPyramid& process(const RgbdFrame& frame);

 private:
  DepthPreprocessor(ComputeContext& compute, const Intrinsics& K, const FusionParams& params);
  [[nodiscard]] Result<void> buildKernels();

  /// Sets the cameras of the pyramid; `K`: of the next depth image.
  void setCamera(const Intrinsics& K);
  void upload(const RgbdFrame& frame);
  void reduceAndFilter();
  void reduce();
  [[nodiscard]] bool halves() const { return ratio_x_ == 2.0F && ratio_y_ == 2.0F; }
  void halve(const Buffer<cl_float>& large, int large_stride, int large_pad, DepthPlane& small);
  void buildSurface(const DepthPlane& plane, DepthPyramid::Level& level);

  ComputeContext& compute_;
  Intrinsics K_recording_;  // of frames without their own
  FusionParams params_;
  float ratio_x_ = 1;
  float ratio_y_ = 1;
  Buffer<cl_ushort> units_;
  DepthPlane reduced_;
  std::vector<DepthPlane> planes_;  ///< filtered, one a level
  DepthPyramid pyramid_;
  Kernel convert_, reduce_, halve_, filter_, build_surface_;
};

}  // namespace scantrove
