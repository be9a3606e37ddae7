#include "core/pipeline/camera_continuation.h"

#include <utility>

namespace scantrove {

std::optional<CameraMemory> CameraContinuation::memory() {
  if (fusion_.surface().vertices_world.size() == 0) return std::nullopt;
  tracking_.awaitNext();  // the next frame that it prepares will not come
  CameraMemory memory;
  fusion_.save(memory);
  if (PoseTracker* tracker = tracking_.tracker()) {
    memory.tracker = tracker->memory();
    memory.reference_normals_world = readView(compute_, tracking_.reference()).normals_world;
  }
  return memory;
}

bool CameraContinuation::restoreState(CameraMemory memory) {
  PoseTracker* tracker = tracking_.tracker();
  if (tracker != nullptr && !memory.tracker) return false;
  tracking_.setK(memory.view.K);
  fusion_.restore(memory);
  if (tracker == nullptr) return true;
  memory.view.normals_world = std::move(memory.reference_normals_world);
  SurfaceMaps reference;
  writeView(compute_, memory.view, reference);
  tracking_.setReference(reference);
  tracker->restoreState(std::move(*memory.tracker));
  return true;
}

void CameraContinuation::interrupt() {
  tracking_.awaitNext();
  if (PoseTracker* tracker = tracking_.tracker()) tracker->interrupt();
}

void CameraContinuation::forgetDevice() {
  if (PoseTracker* tracker = tracking_.tracker()) tracker->forgetDevice();
}

bool CameraContinuation::replayPose(const Eigen::Isometry3d& T_world_camera) {
  PoseTracker* tracker = tracking_.tracker();
  return tracker != nullptr && tracker->replayPose(T_world_camera);
}

void CameraContinuation::addKeyFrame(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera) {
  PoseTracker* tracker = tracking_.tracker();
  if (tracker == nullptr || !tracking_.isOfRecordedSize(frame)) return;
  const DepthPyramid& depth = tracking_.prepare(frame);
  fusion_.raycast(T_world_camera, tracking_.intrinsics());
  tracker->addKeyFrame(frame, depth, fusion_.surface());
}

void CameraContinuation::relocalizeNear(const Eigen::Isometry3d& T_world_camera) {
  PoseTracker* tracker = tracking_.tracker();
  if (tracker == nullptr) return;
  fusion_.raycast(T_world_camera, tracking_.intrinsics());
  tracking_.setReference(fusion_.surface());
  tracker->relocalizeNear(T_world_camera);
}

}  // namespace scantrove
