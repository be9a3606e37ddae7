#pragma once
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/brick_map.h"
#include "core/fusion/fusion_params.h"
#include "core/fusion/surface_maps.h"

namespace scantrove {

/// Renders the surface of a brick map from a camera: V_t and N_t (thesis 3.1). The context's thread.
class Raycaster {
 public:
  [[nodiscard]] static Result<Raycaster> create(ComputeContext& compute, const FusionParams& params);

  /// Fills `surface` for its `K` and `T_world_camera`; its `window` must hold the pages of that view.
  /// `slots`: the bricks in view.
  void cast(const BrickMap& map, std::span<const cl_int> slots, SurfaceMaps& surface);

 private:
  Raycaster(ComputeContext& compute, const FusionParams& params) : compute_(&compute), params_(params) {}
  void findRanges(const BrickMap& map, std::span<const cl_int> slots, const SurfaceMaps& surface);

  ComputeContext* compute_;
  FusionParams params_;
  Kernel cast_rays_;
  Kernel fit_planes_;
  Kernel orient_surface_;
  Buffer<cl_float2> ranges_;
  Buffer<cl_float> inverse_depths_;
  Buffer<cl_float> planes_;
  std::vector<cl_float2> host_ranges_;
};

}  // namespace scantrove
