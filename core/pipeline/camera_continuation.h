#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/capture/rgbd_frame.h"
#include "core/compute/compute_context.h"
#include "core/pipeline/camera_memory.h"
#include "core/pipeline/frame_tracking.h"
#include "core/pipeline/map_fusion.h"

namespace scantrove {

/// How the camera of a scan that goes on in an earlier map finds its way, and what it leaves for the next
/// one. One thread, the context's; may throw cl::Error.
class CameraContinuation {
 public:
  /// All outlive this.
  CameraContinuation(ComputeContext& compute, FrameTracking& tracking, MapFusion& fusion)
      : compute_(compute), tracking_(tracking), fusion_(fusion) {}

  /// What the camera of a scan that goes on in this map is followed by. None before the first usable frame.
  [[nodiscard]] std::optional<CameraMemory> memory();
  /// The map's last frame was that one's. False: the memory does not tell enough.
  [[nodiscard]] bool restoreState(CameraMemory memory);

  /// Of a scan that broke off, frame by frame: the camera of this map was there; those that are not lost, in
  /// order. Whether its frame was a tracking key frame: then addKeyFrame() wants it.
  [[nodiscard]] bool recallPose(const Eigen::Isometry3d& T_world_camera);
  /// An earlier frame of this map, taken from there: by it a camera finds its way back.
  void addKeyFrame(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera);
  /// The camera is somewhere on the map, perhaps there.
  void relocalizeNear(const Eigen::Isometry3d& T_world_camera);

 private:
  ComputeContext& compute_;
  FrameTracking& tracking_;
  MapFusion& fusion_;
};

}  // namespace scantrove
