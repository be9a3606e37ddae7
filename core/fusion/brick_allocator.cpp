#include "core/fusion/brick_allocator.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/compute/kernel_types.h"
#include "core/fusion/image_limits.h"
#include "embedded/fusion_kernels.h"

namespace scantrove {
namespace {

constexpr std::size_t kSeenSize = 32768;       // list_missing_bricks.cl
constexpr std::size_t kFirstListSize = 16384;  // grows when a frame needs more

// Rays of a 120 degree view are at most twice as long as their depth.
// The most faces of bricks that the band of a reading can cross along one axis.
cl_int crossingsOf(const FusionParams& params) {
  const int crossings = static_cast<int>(std::ceil(2.0F * params.truncation_vox * 1.5F / BRICK_SIDE));
  return std::max(1, crossings);
}

}  // namespace

Result<BrickAllocator> BrickAllocator::create(ComputeContext& compute, const FusionParams& params) {
  BrickAllocator result(compute, params);
  SCANTROVE_TRY(
      moveInto(result.find_missing_bricks_, compute.kernel(kernels::fusion, "find_missing_bricks")));
  SCANTROVE_TRY(
      moveInto(result.list_missing_bricks_, compute.kernel(kernels::fusion, "list_missing_bricks")));
  result.seen_ = Buffer<cl_uint>(compute.context(), kSeenSize);
  result.list_ = Buffer<cl_int4>(compute.context(), kFirstListSize);
  result.count_ = Buffer<cl_int>(compute.context(), 1);
  return result;
}

int BrickAllocator::allocate(BrickMap& map, const BrickWindow& window, const DepthPyramid& frame,
                             const Eigen::Isometry3d& T_world_camera) {
  SCANTROVE_CHECK(frame.K.width >= kMinWidth_px);
  const cl::NDRange groups = compute_->lanes().overRows(frame.K.width, frame.K.height);
  const std::size_t group_count = groups.get()[0] * groups.get()[1];
  if (missing_.size() < group_count) missing_ = Buffer<cl_uchar>(compute_->context(), group_count);
  const double voxel_size_m = map.voxelSize();
  const Eigen::Matrix4d T_window_camera =
      window.fromCamera(T_world_camera, BRICK_SIDE * voxel_size_m, voxel_size_m);
  const float truncation_m = params_.truncation_vox * map.voxelSize();
  const cl_float2 depth_range{{params_.min_depth_m, params_.max_depth_m}};
  find_missing_bricks_.launch(groups, compute_->lanes().rowGroup(), frame.depth_m, frame.K.width,
                              frame.K.height, toKernel(frame.K.fx, frame.K.fy, frame.K.cx, frame.K.cy),
                              toKernel(Eigen::Isometry3d(T_window_camera)), truncation_m, depth_range,
                              window.cells(), map.device().pageSlots(), window.size(), crossingsOf(params_),
                              missing_);

  std::vector<cl_int4> found = listMissing(map, window, frame, T_world_camera, groups);
  if (found.empty()) return 0;
  std::vector<Eigen::Vector3i> bricks;
  bricks.reserve(found.size());
  for (const cl_int4& brick : found) {
    bricks.push_back(window.firstBrick() + Eigen::Vector3i(brick.s[0], brick.s[1], brick.s[2]));
  }
  sortBricks(bricks);
  return map.allocate(bricks);
}

std::vector<cl_int4> BrickAllocator::listMissing(const BrickMap& map, const BrickWindow& window,
                                                 const DepthPyramid& frame,
                                                 const Eigen::Isometry3d& T_world_camera,
                                                 const cl::NDRange& groups) {
  const float truncation_m = params_.truncation_vox * map.voxelSize();
  const double brick_size_m = BRICK_SIDE * static_cast<double>(map.voxelSize());
  const cl_float16 T_window_camera =
      toKernel(Eigen::Isometry3d(window.fromCamera(T_world_camera, brick_size_m, brick_size_m)));
  const cl_float4 K = toKernel(frame.K.fx, frame.K.fy, frame.K.cx, frame.K.cy);
  const cl_float2 depth_range{{params_.min_depth_m, params_.max_depth_m}};
  while (true) {
    seen_.fill(compute_->queue(), 0);
    count_.fill(compute_->queue(), 0);
    list_missing_bricks_.launch(groups, compute_->lanes().rowGroup(), frame.depth_m, frame.K.width,
                                frame.K.height, K, T_window_camera, truncation_m, depth_range, window.cells(),
                                map.device().pageSlots(), window.size(), crossingsOf(params_), missing_,
                                seen_, list_, static_cast<cl_int>(list_.size()), count_);
    cl_int count = 0;
    count_.read(compute_->queue(), std::span(&count, 1));
    const auto found = static_cast<std::size_t>(count);
    if (found > list_.size()) {
      // A truncated list would depend on the order of the threads, so repeat with room for all.
      list_ = Buffer<cl_int4>(compute_->context(), 2 * found);
      continue;
    }
    std::vector<cl_int4> result(found);
    list_.read(compute_->queue(), std::span<cl_int4>(result));
    return result;
  }
}

}  // namespace scantrove
