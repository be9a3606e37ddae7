#include "core/fusion/integrator.h"

#include <algorithm>

#include "core/compute/kernel_types.h"
#include "core/fusion/kernels/brick_work.h"
#include "core/fusion/kernels/depth_tiles.h"
#include "embedded/fusion_kernels.h"

namespace scantrove {
namespace {

constexpr std::size_t kGroupBricks = 8;  // bricks per work-group of integrate_bricks, with vectors

constexpr std::size_t depthTiles(int pixels) { return static_cast<std::size_t>(DEPTH_TILES(pixels)); }

}  // namespace

Result<Integrator> Integrator::create(ComputeContext& compute, const FusionParams& params) {
  Integrator result(compute, params);
  SCANTROVE_TRY(moveInto(result.reduce_depth_tiles_, compute.kernel(kernels::fusion, "reduce_depth_tiles")));
  SCANTROVE_TRY(
      moveInto(result.find_brick_readings_, compute.kernel(kernels::fusion, "find_brick_readings")));
  SCANTROVE_TRY(moveInto(result.integrate_bricks_, compute.kernel(kernels::fusion, "integrate_bricks")));
  return result;
}

void Integrator::integrate(BrickMap& map, const BrickWindow& window, std::span<const cl_int> slots,
                           const DepthPyramid& frame, const Eigen::Isometry3d& T_world_camera) {
  host_bricks_.clear();
  first_brick_ = window.firstBrick();
  if (slots.empty()) return;
  for (const cl_int slot : slots) {
    const Eigen::Vector3i brick = map.device().positionOf(slot) - window.firstBrick();
    host_bricks_.push_back({{brick.x(), brick.y(), brick.z(), slot}});
  }
  if (bricks_.size() < slots.size()) {
    bricks_ = Buffer<cl_int4>(compute_->context(), 2 * slots.size());
    readings_ = Buffer<cl_float2>(compute_->context(), 2 * slots.size());
    empty_ = Buffer<cl_uchar>(compute_->context(), 2 * slots.size());
  }
  bricks_.write(compute_->queue(), host_bricks_);

  const double voxel_size_m = map.voxelSize();
  Eigen::Isometry3d T_camera_window =
      Eigen::Isometry3d(window.fromCamera(T_world_camera, BRICK_SIDE * voxel_size_m, 1.0)).inverse();
  T_camera_window.linear() *= voxel_size_m;
  const cl_float16 T = toKernel(T_camera_window);
  const cl_float4 K = toKernel(frame.K.fx, frame.K.fy, frame.K.cx, frame.K.cy);
  const auto count = static_cast<cl_int>(slots.size());
  const float truncation_m = params_.truncation_vox * map.voxelSize();
  const auto max_weight = static_cast<cl_int>(std::clamp(params_.max_weight, 1.0F, 255.0F));

  const cl::NDRange tile_grid(depthTiles(frame.K.width), depthTiles(frame.K.height));
  const std::size_t tile_count = tile_grid.get()[0] * tile_grid.get()[1];
  if (extents_.size() < tile_count) extents_ = Buffer<cl_float2>(compute_->context(), tile_count);
  reduce_depth_tiles_.launch(tile_grid, cl::NullRange, frame.depth_m, frame.K.width, frame.K.height,
                             params_.max_depth_m, extents_);
  find_brick_readings_.launch(cl::NDRange(slots.size()), cl::NDRange(64), bricks_, count, T, K, frame.K.width,
                              frame.K.height, extents_, params_.max_depth_m, readings_);
  const std::size_t items = BRICK_ITEMS(compute_->lanes().count());
  integrate_bricks_.launch(cl::NDRange(items * slots.size()), cl::NDRange(items > 1 ? items : kGroupBricks),
                           bricks_, count, readings_, T, K, frame.K.width, frame.K.height, frame.depth_m,
                           params_.max_depth_m, truncation_m, max_weight, map.pools().distances(),
                           map.pools().weights(), empty_);
}

std::vector<Eigen::Vector3i> Integrator::takeEmptyBricks() {
  std::vector<cl_uchar> empty(host_bricks_.size());
  empty_.read(compute_->queue(), std::span<cl_uchar>(empty));
  std::vector<Eigen::Vector3i> result;
  for (std::size_t i = 0; i < host_bricks_.size(); ++i) {
    const cl_int4& brick = host_bricks_[i];
    if (empty[i] != 0) result.push_back(first_brick_ + Eigen::Vector3i(brick.s[0], brick.s[1], brick.s[2]));
  }
  host_bricks_.clear();
  return result;
}

}  // namespace scantrove
