#include "core/fusion/dense_map.h"

#include <utility>

#include "core/fusion/view_depths.h"

namespace scantrove {

DenseMap::DenseMap(ComputeContext& compute, const FusionParams& params, BrickAllocator allocator,
                   Integrator integrator, Raycaster raycaster)
    : compute_(compute),
      params_(params),
      bricks_(compute, params.voxel_size_m, brickBudget(params, compute)),
      allocator_(std::move(allocator)),
      integrator_(std::move(integrator)),
      raycaster_(std::move(raycaster)) {}

Result<std::unique_ptr<DenseMap>> DenseMap::create(ComputeContext& compute, const FusionParams& params) {
  Result<BrickAllocator> allocator = BrickAllocator::create(compute, params);
  if (!allocator) return fail(allocator.error());
  Result<Integrator> integrator = Integrator::create(compute, params);
  if (!integrator) return fail(integrator.error());
  Result<Raycaster> raycaster = Raycaster::create(compute, params);
  if (!raycaster) return fail(raycaster.error());
  return std::unique_ptr<DenseMap>(
      new DenseMap(compute, params, std::move(*allocator), std::move(*integrator), std::move(*raycaster)));
}

void DenseMap::integrate(const DepthPyramid& frame, const Eigen::Isometry3d& T_world_camera) {
  const float truncation_m = params_.truncation_vox * params_.voxel_size_m;
  const ViewFrustum frustum(T_world_camera, frame.K, kNearestView_m, params_.max_depth_m + truncation_m);
  settle();
  beginFrame(frustum, window_);
  if (allocator_.allocate(bricks_, window_, frame, T_world_camera) > 0) beginFrame(frustum, window_);
  integrator_.integrate(bricks_, window_, bricks_.device().slotsInPages(pages_, frustum), frame,
                        T_world_camera);
}

void DenseMap::settle() {
  const std::vector<Eigen::Vector3i> empty = integrator_.takeEmptyBricks();
  if (empty.empty()) return;
  bricks_.beginFrame({});  // a separate view, so that the changes are stored
  bricks_.deactivate(empty);
}

void DenseMap::raycast(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K, SurfaceMaps& surface) {
  const auto pixels = static_cast<std::size_t>(K.pixels());
  if (surface.vertices_world.size() != pixels) surface.vertices_world = {compute_.context(), pixels};
  if (surface.normals_world.size() != pixels) surface.normals_world = {compute_.context(), pixels};
  surface.K = K;
  surface.T_world_camera = T_world_camera;
  const ViewFrustum frustum(T_world_camera, K, kNearestView_m, params_.max_depth_m);
  beginFrame(frustum, surface.window);
  raycaster_.cast(bricks_, bricks_.device().slotsInPages(pages_, frustum), surface);
}

void DenseMap::beginFrame(const ViewFrustum& frustum, BrickWindow& window) {
  pages_ = bricks_.pages().pagesInView(frustum, BRICK_SIDE * static_cast<double>(bricks_.voxelSize()));
  bricks_.beginFrame(pages_);
  window.set(compute_, bricks_.pages(), pages_);
}

}  // namespace scantrove
