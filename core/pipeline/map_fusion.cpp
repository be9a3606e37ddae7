#include "core/pipeline/map_fusion.h"

#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

namespace scantrove {

Result<std::unique_ptr<MapFusion>> MapFusion::create(ComputeContext& compute, StageTimer& timer,
                                                     const FusionParams& params) {
  std::unique_ptr<MapFusion> fusion(new MapFusion(compute, timer));
  SCANTROVE_TRY(moveInto(fusion->motion_, MotionFilter::create(compute, params)));
  SCANTROVE_TRY(moveInto(fusion->map_, DenseMap::create(compute, params)));
  SCANTROVE_TRY(moveInto(fusion->color_, ColorIntegrator::create(compute, params)));
  return fusion;
}

void MapFusion::integrate(const DepthPyramid& depth, const Eigen::Isometry3d& T_world_camera) {
  const DepthPyramid& still = timer_.time(
      "filter", [&]() -> const DepthPyramid& { return motion_->still(depth, T_world_camera, known_); });
  timer_.time("integrate", [&] { map_->integrate(still, T_world_camera); });
}

void MapFusion::raycast(const DepthPyramid& depth, const Eigen::Isometry3d& T_world_camera,
                        const Intrinsics& K) {
  map_->raycast(T_world_camera, K, surface_);
  motion_->apply(depth, bricks(), surface_);
}

void MapFusion::raycast(const Eigen::Isometry3d& T_world_camera, const Intrinsics& K) {
  map_->raycast(T_world_camera, K, surface_);
  known_ = KnownSurface(readView(compute_, surface_));
}

void MapFusion::integrateColor(const RgbdFrame& frame, const RenderedView& view, const DepthPyramid& depth,
                               const cv::Mat& hidden) {
  color_->integrate(bricks(), {surface_, view, depth, hidden}, frame);
}

std::span<const std::uint8_t> MapFusion::newlyAppeared() {
  if (motion_->appeared().empty()) return {};
  cv::resize(motion_->appeared(), appeared_, {surface_.K.width, surface_.K.height}, 0, 0, cv::INTER_NEAREST);
  return {appeared_.ptr<std::uint8_t>(), appeared_.total()};
}

void MapFusion::save(CameraMemory& memory) {
  memory.free_space = motion_->freeSpace().memory();
  memory.appeared_objects = motion_->appearedObjects().memory();
  memory.color_turns = color_->turns();
  memory.view = readView(compute_, surface_);
}

void MapFusion::restore(CameraMemory& memory) {
  surface_ = {};
  writeView(compute_, memory.view, surface_);
  known_ = KnownSurface(memory.view);
  motion_->freeSpace().restoreState(std::move(memory.free_space));
  motion_->appearedObjects().restoreState(std::move(memory.appeared_objects));
  color_->restoreState(memory.color_turns);
}

}  // namespace scantrove
