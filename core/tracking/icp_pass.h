#pragma once
#include <vector>

#include "core/base/result.h"
#include "core/compute/compute_context.h"
#include "core/fusion/depth_pyramid.h"
#include "core/fusion/surface_maps.h"
#include "core/tracking/icp_system.h"

namespace scantrove {

/// Association gates and weights of a pass. Depth noise of structured light grows with z^2.
struct IcpGates {
  float distance_m = 0;  ///< largest distance of associated pairs; plus distance_per_z2 * z^2
  float distance_per_z2 = 0;
  float normal_cosine = 0.86F;  ///< least cosine of the angle between normals, about 30 degrees
  // Weights: 1 / n^2 with n = 1 + noise_per_z2 * z^2; linear (Huber) for residuals beyond huber_m * n.
  float huber_m = 0;
  float noise_per_z2 = 0;
  // The same for the residual that judges the fit; milder, so that far surfaces count.
  float fit_huber_m = 0;
  float fit_noise_per_z2 = 0;

  /// Gates for a camera with `depth_noise_m` of noise at 1 m (FusionParams).
  [[nodiscard]] static IcpGates of(float distance_m, float depth_noise_m);
};

/// Runs accumulate_icp: the sums of one frame level against the model at one pose. One thread, the context's;
/// throws cl::Error on a device fault. The same input gives the same sums, bit for bit.
class IcpPass {
 public:
  [[nodiscard]] static Result<IcpPass> create(ComputeContext& compute);

  [[nodiscard]] IcpSystem run(const DepthPyramid::Level& level, const SurfaceMaps& model,
                              const Eigen::Isometry3d& T_world_frame, const IcpGates& gates);

 private:
  explicit IcpPass(ComputeContext& compute) : compute_(&compute) {}

  ComputeContext* compute_;
  Kernel kernel_;
  int group_ = 1;  ///< work-items of a group
  int run_ = 1;    ///< pixels of a work-item
  Buffer<cl_float> sums_;
  std::vector<float> host_sums_;
};

}  // namespace scantrove
