#pragma once
#include <Eigen/Geometry>
#include <optional>

#include "core/capture/rgbd_frame.h"
#include "core/compute/compute_context.h"
#include "core/pipeline/camera_memory.h"
#include "core/pipeline/frame_tracking.h"
#include "core/pipeline/map_fusion.h"

namespace scantrove {

/// The tracking state of a scan that continues an earlier map, and the state that it leaves for the next
/// one. One thread, the context's; may throw cl::Error.
class CameraContinuation {
 public:
  /// All outlive this.
  CameraContinuation(ComputeContext& compute, FrameTracking& tracking, MapFusion& fusion)
      : compute_(compute), tracking_(tracking), fusion_(fusion) {}

  /// The camera state for a scan that continues this map. None before the first usable frame.
  [[nodiscard]] std::optional<CameraMemory> memory();
  /// The next frames are of another recording, so its device's poses are in another world.
  void forgetDevice();
  /// The camera was lost before the next frame, and may be elsewhere in the map.
  void interrupt();
  /// Restores the state after the map's last frame. False: the memory is incomplete.
  [[nodiscard]] bool restoreState(CameraMemory memory);

  /// For an interrupted scan, frame by frame in order, without lost frames: adds the camera's pose. Returns
  /// whether the frame was a tracking key frame: addKeyFrame() must follow.
  [[nodiscard]] bool replayPose(const Eigen::Isometry3d& T_world_camera);
  /// Adds an earlier frame of this map with its pose, for relocalisation. A depth image of another size than
  /// the recording's is ignored.
  void addKeyFrame(const RgbdFrame& frame, const Eigen::Isometry3d& T_world_camera);
  /// The camera is somewhere in the map, perhaps near this pose.
  void relocalizeNear(const Eigen::Isometry3d& T_world_camera);

 private:
  ComputeContext& compute_;
  FrameTracking& tracking_;
  MapFusion& fusion_;
};

}  // namespace scantrove
