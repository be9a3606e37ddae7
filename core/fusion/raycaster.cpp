#include "core/fusion/raycaster.h"

#include <algorithm>
#include <cmath>

#include "core/compute/kernel_types.h"
#include "core/fusion/kernels/ray_layout.h"
#include "core/fusion/view_depths.h"
#include "embedded/fusion_kernels.h"

namespace scantrove {
Result<Raycaster> Raycaster::create(ComputeContext& compute, const FusionParams& params) {
  Raycaster result(compute, params);
  SCANTROVE_TRY(moveInto(result.cast_rays_, compute.kernel(kernels::fusion, "cast_rays")));
  SCANTROVE_TRY(moveInto(result.fit_planes_, compute.kernel(kernels::fusion, "fit_planes")));
  SCANTROVE_TRY(moveInto(result.orient_surface_, compute.kernel(kernels::fusion, "orient_surface")));
  return result;
}

void Raycaster::cast(const BrickMap& map, std::span<const cl_int> slots, SurfaceMaps& surface) {
  const BrickWindow& window = surface.window;
  findRanges(map, slots, surface);
  const double voxel_size_m = map.voxelSize();
  const Eigen::Matrix4d T =
      window.fromCamera(surface.T_world_camera, BRICK_SIDE * voxel_size_m, voxel_size_m);
  const Eigen::Vector3d origin_m = window.firstBrick().cast<double>() * (BRICK_SIDE * voxel_size_m);
  const Intrinsics& K = surface.K;
  const std::size_t padded =
      static_cast<std::size_t>(RAY_STRIDE(K.width)) * static_cast<std::size_t>(K.height + 2 * RAY_PAD);
  if (inverse_depths_.size() != padded) {
    inverse_depths_ = Buffer<cl_float>(compute_->context(), padded);
    inverse_depths_.fill(compute_->queue(), 0.0F);
    planes_ = Buffer<cl_float>(compute_->context(), 4 * padded);
    planes_.fill(compute_->queue(), NO_PLANE);
  }
  const cl_float4 kernel_K = toKernel(K.fx, K.fy, K.cx, K.cy);
  const cl_float16 T_window_camera = toKernel(Eigen::Isometry3d(T));
  const Lanes& lanes = compute_->lanes();
  cast_rays_.launch(lanes.overBlocks(K.width, K.height, RAY_BLOCKS(lanes.count())), lanes.blockGroup(),
                    ranges_, K.width, K.height, kernel_K, T_window_camera, params_.truncation_vox,
                    window.cells(), map.device().pageSlots(), window.size(), map.pools().distances(),
                    inverse_depths_);
  const cl::NDRange rows = lanes.overRows(K.width, K.height);
  fit_planes_.launch(rows, lanes.rowGroup(), inverse_depths_, K.width, K.height, cl_float2{{K.fx, K.fy}},
                     planes_);
  orient_surface_.launch(rows, lanes.rowGroup(), inverse_depths_, planes_, K.width, K.height, kernel_K,
                         T_window_camera, map.voxelSize(),
                         toKernel(static_cast<float>(origin_m.x()), static_cast<float>(origin_m.y()),
                                  static_cast<float>(origin_m.z()), 0.0F),
                         surface.vertices_world, surface.normals_world);
}

// The nearest and farthest depth at which a ray of each tile can meet a brick, from the spheres around the
// bricks.
void Raycaster::findRanges(const BrickMap& map, std::span<const cl_int> slots, const SurfaceMaps& surface) {
  const Intrinsics& K = surface.K;
  const int columns = RAY_TILES(K.width);
  const int rows = RAY_TILES(K.height);
  const auto pitch = static_cast<std::size_t>(columns);
  const std::size_t count = pitch * static_cast<std::size_t>(rows);
  host_ranges_.assign(count, {{params_.max_depth_m, kNearestView_m}});
  const double size_m = BRICK_SIDE * static_cast<double>(map.voxelSize());
  const float radius_m = 0.5F * std::sqrt(3.0F) * static_cast<float>(size_m);
  const Eigen::Isometry3d T_camera_world = surface.T_world_camera.inverse();
  const auto bound = [](float low, float high, float nearest, float farthest, float focal, float center,
                        int count_of) {
    const float from = (focal * std::min(low / nearest, low / farthest) + center) / RAY_TILE;
    const float to = (focal * std::max(high / nearest, high / farthest) + center) / RAY_TILE;
    const float last = static_cast<float>(count_of) - 0.5F;
    return std::pair(static_cast<int>(std::clamp(from, 0.0F, last)),
                     static_cast<int>(std::clamp(to, -1.0F, last)));
  };
  for (const cl_int slot : slots) {
    const Eigen::Vector3d brick = (map.device().positionOf(slot).cast<double>().array() + 0.5) * size_m;
    const Eigen::Vector3f c = (T_camera_world * brick).cast<float>();
    const float nearest = std::max(c.z() - radius_m, kNearestView_m);
    const float farthest = std::max(std::min(c.z() + radius_m, params_.max_depth_m), nearest);
    const auto [left, right] =
        bound(c.x() - radius_m, c.x() + radius_m, nearest, farthest, K.fx, K.cx, columns);
    const auto [top, bottom] = bound(c.y() - radius_m, c.y() + radius_m, nearest, farthest, K.fy, K.cy, rows);
    for (int row = top; row <= bottom; ++row) {
      for (int column = left; column <= right; ++column) {
        cl_float2& range =
            host_ranges_[static_cast<std::size_t>(row) * pitch + static_cast<std::size_t>(column)];
        range.s[0] = std::min(range.s[0], nearest);
        range.s[1] = std::max(range.s[1], farthest);
      }
    }
  }
  if (ranges_.size() != count) ranges_ = Buffer<cl_float2>(compute_->context(), count);
  ranges_.write(compute_->queue(), host_ranges_);
}

}  // namespace scantrove
