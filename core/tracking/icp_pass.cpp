#include "core/tracking/icp_pass.h"

#include <string>

#include "core/compute/kernel_types.h"
#include "core/tracking/kernels/icp_layout.h"
#include "embedded/tracking_kernels.h"

namespace scantrove {
namespace {

// CPU cores with vector lanes process long runs without groups; a GPU needs many short runs. A float sum has
// at most group * run terms.
constexpr int kLongRun_px = 640;
constexpr int kShortRuns = 32;   // of a group
constexpr int kShortRun_px = 8;  // of a work-item

// Standard deviation of a correct model's surface from the true one: half a voxel and the residual
// calibration error of the camera.
constexpr float kModelError_m = 0.003F;
// Noise of the nearest readings: the quantization of depth.
constexpr float kDepthStep_m = 0.00075F;
// Gates in standard deviations: for pairs of two different surfaces, and for outliers.
constexpr float kOtherSurface = 20.0F / 3.0F;
constexpr float kOutlier = 10.0F / 3.0F;
constexpr float kOutlierOfFit = 5.0F / 3.0F;

}  // namespace

IcpGates IcpGates::of(float distance_m, float depth_noise_m) {
  return {.distance_m = distance_m,
          .distance_per_z2 = kOtherSurface * depth_noise_m,
          .huber_m = kOutlier * kDepthStep_m,
          .noise_per_z2 = depth_noise_m / kDepthStep_m,
          .fit_huber_m = kOutlierOfFit * kModelError_m,
          .fit_noise_per_z2 = depth_noise_m / kModelError_m};
}

Result<IcpPass> IcpPass::create(ComputeContext& compute) {
  IcpPass pass(compute);
  const bool has_vectors = compute.lanes().count() > 1;
  pass.group_ = has_vectors ? 1 : kShortRuns;
  pass.run_ = has_vectors ? kLongRun_px : kShortRun_px;
  SCANTROVE_TRY(moveInto(pass.kernel_, compute.kernel(kernels::accumulate_icp, "accumulate_icp",
                                                      "-DGROUP=" + std::to_string(pass.group_))));
  return pass;
}

IcpSystem IcpPass::run(const DepthPyramid::Level& level, const SurfaceMaps& model,
                       const Eigen::Isometry3d& T_world_frame, const IcpGates& gates) {
  const int pixels = level.K.pixels();
  const int per_group = group_ * run_;
  const auto groups = static_cast<std::size_t>((pixels + per_group - 1) / per_group);
  if (sums_.size() < groups * ICP_SUMS) sums_ = Buffer<cl_float>(compute_->context(), groups * ICP_SUMS);
  host_sums_.resize(groups * ICP_SUMS);

  const Eigen::Vector3d center = T_world_frame.translation();
  const Eigen::Vector3f c = center.cast<float>();
  const cl_float8 gate{{gates.distance_m, gates.distance_per_z2, gates.normal_cosine, gates.huber_m,
                        gates.noise_per_z2, gates.fit_huber_m, gates.fit_noise_per_z2, 0}};
  const auto group = static_cast<std::size_t>(group_);
  kernel_.launch(
      cl::NDRange(groups * group), cl::NDRange(group), level.vertices_camera, level.normals_camera,
      cl_int{pixels}, cl_int{run_}, toKernel(T_world_frame), toKernel(model.T_world_camera.inverse()),
      toKernel(model.K.fx, model.K.fy, model.K.cx, model.K.cy), cl_int{model.K.width}, cl_int{model.K.height},
      model.vertices_world, model.normals_world, toKernel(c.x(), c.y(), c.z(), 0), gate, sums_);
  sums_.read(compute_->queue(), host_sums_);
  return IcpSystem::fromSums(host_sums_, c.cast<double>());
}

}  // namespace scantrove
