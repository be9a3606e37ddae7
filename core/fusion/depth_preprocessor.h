#pragma once
#include <memory>

#include "core/base/result.h"
#include "core/capture/rgbd_frame.h"
#include "core/compute/compute_context.h"
#include "core/fusion/depth_pyramid.h"
#include "core/fusion/fusion_params.h"

namespace scantrove {

/// Depth image to metres, edge-preserving filter, pyramid of vertex and normal maps. One thread, the
/// context's.
class DepthPreprocessor {
 public:
  [[nodiscard]] static Result<std::unique_ptr<DepthPreprocessor>> create(ComputeContext& compute,
                                                                         const Intrinsics& K,
                                                                         const FusionParams& params);
  ~DepthPreprocessor();

  /// Depth of 0 or outside [min_depth, max_depth] becomes 0. The result stays valid until the next call.
  [[nodiscard]] const DepthPyramid& process(const RgbdFrame& frame);

 private:
  DepthPreprocessor() = default;
  class Machinery;
  std::unique_ptr<Machinery> machinery_;
};

}  // namespace scantrove
