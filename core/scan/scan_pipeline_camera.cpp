// What a scan that goes on in an earlier map learns of its camera, and what it leaves behind for the next.
#include <utility>

#include "core/scan/scan_pipeline.h"

namespace scantrove {

std::optional<CameraMemory> ScanPipeline::cameraMemory() {
  if (surface_.vertices_world.size() == 0) return std::nullopt;
  if (next_attempt_.valid()) next_attempt_.wait();  // at a frame that will not come
  CameraMemory memory;
  if (tracker_) memory.tracker = tracker_->memory();
  memory.free_space = motion_->freeSpace().memory();
  memory.appeared_objects = motion_->appeared_objects().memory();
  memory.color_turns = color_integrator_->turns();
  memory.view = readView(compute_, surface_);
  if (tracker_) memory.followed_normals_world = readView(compute_, followed_).normals_world;
  return memory;
}

bool ScanPipeline::restoreState(CameraMemory memory) {
  if (tracker_ && !memory.tracker) return false;
  working_K_ = memory.view.K;
  surface_ = {};
  writeView(compute_, memory.view, surface_);
  known_ = KnownSurface(memory.view);
  motion_->freeSpace().restoreState(std::move(memory.free_space));
  motion_->appeared_objects().restoreState(std::move(memory.appeared_objects));
  color_integrator_->restoreState(memory.color_turns);
  if (!tracker_) return true;
  memory.view.normals_world = std::move(memory.followed_normals_world);
  followed_ = {};
  writeView(compute_, memory.view, followed_);
  tracker_->restoreState(std::move(*memory.tracker));
  return true;
}

void ScanPipeline::relocalizeNear(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera) {
  if (!tracker_) return;
  const DepthPyramid& depth = preprocessor_->process(frame);
  working_K_ = depth.levels.front().K;
  map_->raycast(T_world_camera, working_K_, surface_);
  known_ = KnownSurface(readView(compute_, surface_));
  tracker_->addKeyFrame(frame, depth, surface_);
}

void ScanPipeline::resumeAt(const Eigen::Isometry3d& T_world_camera) {
  if (!tracker_) return;
  map_->raycast(T_world_camera, working_K_, surface_);
  known_ = KnownSurface(readView(compute_, surface_));
  followed_ = surface_;
  tracker_->resumeAt(T_world_camera);
}

}  // namespace scantrove
