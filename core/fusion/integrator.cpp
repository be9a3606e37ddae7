#include "core/fusion/integrator.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/compute/kernel_types.h"
#include "embedded/fusion_kernels.h"

namespace scantrove {
namespace {

constexpr int kTile = 16;                        // pixels; the tiles of reduce_depth_tiles
constexpr std::size_t kRows = BRICK_VOXELS / 8;  // work-items of integrate_bricks for one brick

constexpr int tiles(int pixels) { return (pixels + kTile - 1) / kTile; }

}  // namespace

Result<Integrator> Integrator::create(ComputeContext& compute, const FusionParams& params) {
  Result<Kernel> reduce =
      compute.kernel(kernels::reduce_depth_tiles, "reduce_depth_tiles", "-DTILE=" + std::to_string(kTile));
  if (!reduce) return fail(reduce.error());
  Result<Kernel> integrate = compute.kernel(kernels::integrate_bricks, "integrate_bricks");
  if (!integrate) return fail(integrate.error());
  Integrator result(compute, params);
  result.reduce_depth_tiles_ = *reduce;
  result.integrate_bricks_ = *integrate;
  return result;
}

void Integrator::integrate(BrickMap& map, const BrickWindow& window, std::span<const cl_int> slots,
                           const DepthPyramid& frame, const Eigen::Isometry3d& T_world_camera) {
  if (slots.empty()) return;
  readFarthest(frame);
  const double voxel_size_m = map.voxelSize();
  Eigen::Isometry3d T_voxel_window =
      Eigen::Isometry3d(window.fromCamera(T_world_camera, BRICK_SIDE * voxel_size_m, 1));
  Eigen::Isometry3d T_camera_window = T_voxel_window.inverse();
  T_camera_window.linear() *= voxel_size_m;

  const Eigen::Isometry3f T_camera_voxel = T_camera_window.cast<float>();
  const float radius_m = 0.5F * std::sqrt(3.0F) * BRICK_SIDE * map.voxelSize();
  host_bricks_.clear();
  for (const cl_int slot : slots) {
    const Eigen::Vector3i brick = map.positionOf(slot) - window.firstBrick();
    const Eigen::Vector3f centre = (brick.cast<float>().array() + 0.5F) * static_cast<float>(BRICK_SIDE);
    if (mayChange(frame, T_camera_voxel * centre, radius_m)) {
      host_bricks_.push_back({{brick.x(), brick.y(), brick.z(), slot}});
    }
  }
  if (host_bricks_.empty()) return;
  if (bricks_.size() < host_bricks_.size())
    bricks_ = Buffer<cl_int4>(compute_->context(), 2 * host_bricks_.size());
  bricks_.write(compute_->queue(), host_bricks_);
  const float max_weight = 256.0F * std::clamp(params_.max_weight, 1.0F, 255.0F);
  integrate_bricks_.launch(cl::NDRange(host_bricks_.size() * kRows), cl::NDRange(kRows), bricks_,
                           static_cast<cl_int>(host_bricks_.size()), toKernel(T_camera_window),
                           toKernel(frame.K.fx, frame.K.fy, frame.K.cx, frame.K.cy), frame.K.width,
                           frame.K.height, frame.depth_m, params_.max_depth_m,
                           params_.truncation_vox * map.voxelSize(), max_weight, map.voxels());
}

void Integrator::readFarthest(const DepthPyramid& frame) {
  const auto columns = static_cast<std::size_t>(tiles(frame.K.width));
  const auto rows = static_cast<std::size_t>(tiles(frame.K.height));
  if (farthest_.size() != columns * rows) farthest_ = Buffer<cl_float>(compute_->context(), columns * rows);
  reduce_depth_tiles_.launch(cl::NDRange(columns, rows), cl::NullRange, frame.depth_m, frame.K.width,
                             frame.K.height, params_.max_depth_m, farthest_);
  host_farthest_.resize(columns * rows);
  farthest_.read(compute_->queue(), std::span<cl_float>(host_farthest_));
}

// A brick changes only if one of its voxels is in front of, or less than a truncation behind, a reading.
bool Integrator::mayChange(const DepthPyramid& frame, const Eigen::Vector3f& centre_camera,
                           float radius_m) const {
  const float nearest = centre_camera.z() - radius_m;
  const float needed = nearest - params_.truncation_vox * params_.voxel_size_m;
  if (nearest <= 0.01F) return true;
  // The sphere's box as seen at its nearest depth and at its farthest bounds its image.
  const float farthest = centre_camera.z() + radius_m;
  const auto bound = [&](float low, float high, float focal, float centre, int pixels) {
    const float from = focal * std::min(low / nearest, low / farthest) + centre + 0.5F;
    const float to = focal * std::max(high / nearest, high / farthest) + centre + 0.5F;
    const float last = static_cast<float>(pixels - 1);
    return std::pair(static_cast<int>(std::clamp(from, 0.0F, last)) / kTile,
                     static_cast<int>(std::clamp(to, 0.0F, last)) / kTile);
  };
  const auto [left, right] = bound(centre_camera.x() - radius_m, centre_camera.x() + radius_m, frame.K.fx,
                                   frame.K.cx, frame.K.width);
  const auto [top, bottom] = bound(centre_camera.y() - radius_m, centre_camera.y() + radius_m, frame.K.fy,
                                   frame.K.cy, frame.K.height);
  const int columns = tiles(frame.K.width);
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) {
      const float reading = host_farthest_[static_cast<std::size_t>(row * columns + column)];
      if (reading > 0.0F && reading > needed) return true;
    }
  }
  return false;
}

}  // namespace scantrove
