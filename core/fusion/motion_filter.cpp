#include "core/fusion/motion_filter.h"

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "core/compute/kernel_types.h"
#include "core/fusion/moving_pixels.h"
#include "embedded/fusion_kernels.h"

namespace scantrove {
namespace {

/// The pyramid level used. A hand 3 m away is some pixels wide there.
constexpr std::size_t kLevel = 1;
/// Fewer pixels are noise.
constexpr int kMinPixels = 12;
/// Surface is settled after kSettled observations. If more than kMaxFresh of it is not, all of it counts.
constexpr cl_int kSettled = 4;
constexpr double kMaxFresh = 0.3;

DepthView viewOf(ComputeContext& compute, const DepthPyramid& frame,
                 const Eigen::Isometry3d& T_world_camera) {
  const DepthPyramid::Level& level = frame.levels[std::min(kLevel, frame.levels.size() - 1)];
  std::vector<cl_float4> vertices(level.vertices_camera.size());
  level.vertices_camera.read(compute.queue(), std::span(vertices));
  DepthView view{level.K, T_world_camera, cv::Mat(level.K.height, level.K.width, CV_32FC1)};
  auto* z = view.z_m.ptr<float>();
  for (const cl_float4& vertex : vertices) *z++ = vertex.s[3] > 0 ? vertex.s[2] : 0.0F;
  return view;
}

/// The mask, or an empty one if it has under kMinPixels pixels.
cv::Mat orNone(cv::Mat mask) { return cv::countNonZero(mask) < kMinPixels ? cv::Mat() : std::move(mask); }

cl::NDRange pixelsOf(const Intrinsics& K) {
  return {static_cast<std::size_t>(K.width), static_cast<std::size_t>(K.height)};
}

}  // namespace

Result<std::unique_ptr<MotionFilter>> MotionFilter::create(ComputeContext& compute,
                                                           const FusionParams& params) {
  std::unique_ptr<MotionFilter> filter(new MotionFilter(compute, params));
  SCANTROVE_TRY(moveInto(filter->leave_out_depth_, compute.kernel(kernels::fusion, "leave_out_depth")));
  SCANTROVE_TRY(moveInto(filter->leave_out_fresh_, compute.kernel(kernels::fusion, "leave_out_fresh")));
  filter->fresh_counts_ = {compute.context(), 2};
  SCANTROVE_TRY(moveInto(filter->mark_mismatch_, compute.kernel(kernels::fusion, "mark_mismatch")));
  SCANTROVE_TRY(moveInto(filter->leave_out_surface_, compute.kernel(kernels::fusion, "leave_out_surface")));
  return filter;
}

const DepthPyramid& MotionFilter::still(const DepthPyramid& frame, const Eigen::Isometry3d& T_world_camera,
                                        const KnownSurface& known) {
  const DepthView view = viewOf(compute_, frame, T_world_camera);
  const cv::Mat consistencies = known.consistencies(view, params_.depth_noise_m);
  const cv::Mat intruding = free_space_.contradicting(view);
  moving_ = orNone(movingPixels(intruding, consistencies, view.z_m));
  vacated_ = orNone(vacatedPixels(consistencies));
  free_space_.add(view);
  appeared_objects_.add(view, moving_, intruding);
  appeared_ = appeared_objects_.atRest(view, moving_);
  still_ = frame;
  if (moving_.empty()) return still_;
  if (depth_m_.size() != frame.depth_m.size()) depth_m_ = {compute_.context(), frame.depth_m.size()};
  still_.depth_m = depth_m_;
  leave_out_depth_.launch(pixelsOf(frame.K), cl::NullRange, sent(moving_), cl_int{moving_.cols},
                          cl_int{moving_.rows}, frame.depth_m, depth_m_);
  return still_;
}

void MotionFilter::apply(const DepthPyramid& frame, BrickMap& bricks, SurfaceMaps& surface) {
  if (!vacated_.empty()) markMismatch(frame, bricks, surface);
  if (moving_.empty()) return;
  leave_out_surface_.launch(pixelsOf(surface.K), cl::NullRange, sent(moving_), cl_int{moving_.cols},
                            cl_int{moving_.rows}, surface.vertices_world, surface.normals_world);
}

void MotionFilter::markMismatch(const DepthPyramid& frame, BrickMap& bricks, const SurfaceMaps& surface) {
  const Eigen::Vector3f eye = surface.T_world_camera.translation().cast<float>();
  const float at_0_m = kBehind.at(0, params_.depth_noise_m);
  const cl_float2 apart{{at_0_m, kBehind.at(1, params_.depth_noise_m) - at_0_m}};
  mark_mismatch_.launch(pixelsOf(surface.K), cl::NullRange, sent(vacated_), cl_int{vacated_.cols},
                        cl_int{vacated_.rows}, frame.levels.front().vertices_camera, surface.vertices_world,
                        toKernel(surface.T_world_camera.inverse()), toKernel(eye.x(), eye.y(), eye.z(), 0),
                        apart, bricks.voxelSize(), params_.truncation_vox * bricks.voxelSize(),
                        bricks.device().table(), bricks.device().tableMask(), bricks.pools().weights());
}

const SurfaceMaps& MotionFilter::settled(const SurfaceMaps& surface, const BrickMap& bricks) {
  const std::size_t pixels = surface.vertices_world.size();
  if (settled_normals_.size() != pixels) settled_normals_ = {compute_.context(), pixels};
  fresh_counts_.fill(compute_.queue(), 0);
  leave_out_fresh_.launch(compute_.lanes().inTurn(pixels), compute_.lanes().inTurnGroup(),
                          surface.vertices_world, surface.normals_world, static_cast<cl_int>(pixels),
                          surface.window.cells(), bricks.device().pageSlots(), surface.window.size(),
                          surface.window.first(), bricks.pools().weights(), 1 / bricks.voxelSize(), kSettled,
                          settled_normals_, fresh_counts_);
  std::array<cl_int, 2> counts{};
  fresh_counts_.read(compute_.queue(), std::span<cl_int>(counts));
  settled_ = surface;
  if (counts[0] <= kMaxFresh * counts[1]) settled_.normals_world = settled_normals_;
  return settled_;
}

const Buffer<cl_uchar>& MotionFilter::sent(const cv::Mat& mask) {
  if (mask_.size() != mask.total()) mask_ = {compute_.context(), mask.total()};
  mask_.write(compute_.queue(), {mask.ptr<cl_uchar>(), mask.total()});
  return mask_;
}

}  // namespace scantrove
