#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/color_camera.h"
#include "core/capture/depth_plausibility.h"
#include "core/capture/instance_name.h"
#include "core/capture/intrinsics.h"
#include "core/capture/rgbd_frame.h"

namespace scantrove {

/// Where a recording's own poses come from.
enum class PoseOrigin {
  truth,   ///< a benchmark's reference: for evaluation, and where poses are given
  device,  ///< the device tracked itself (ARKit, odometry): a prediction, which may drift
};

/// Properties of an open source.
struct SourceInfo {
  std::string name;  ///< to display: the folder's name, the camera's name
  std::string kind;  ///< "7-Scenes", "TUM RGB-D", "BOP", "NYUv2 raw", "numbered images", "OpenNI2 camera",
                     ///< "OpenNI2 recording", "libfreenect camera", "RealSense camera", "Record3D phone",
                     ///< "ROS bag", "ROS 2 bag", "MCAP", "RealSense recording", "Azure Kinect recording",
                     ///< "synthetic", or the app: "Polycam"
  Intrinsics intrinsics;
  std::optional<int> frame_count;  ///< frames that next() will return in total; empty for a live camera
  bool is_live = false;
  /// Some frames have no colour image, because the device stores fewer of them than depth images.
  bool is_color_optional = false;
  bool has_poses = false;
  PoseOrigin pose_origin = PoseOrigin::truth;         ///< where the source has poses
  std::optional<ImplausibleDepth> implausible_depth;  ///< of a recording: its depth scale seems wrong
  std::vector<InstanceName> instances;  ///< names of the masks in RgbdFrame::instances; empty without masks
};

/// Result of one call of FrameSource::next().
struct FrameRead {
  enum class Status {
    frame,    ///< `frame` is filled
    skipped,  ///< unusable frame (truncated image, NaN pose); `error` says why; continue reading
    timeout,  ///< a live camera sent nothing for a second, or a frame is left out (RestOfSource); continue
              ///< reading. With an `error`: the camera is lost, and frames go on when it is connected again
    end,      ///< the recording is over; with an `error`: a lost camera did not come back
    failed,   ///< the source is lost (unplugged, folder removed); `error` says why; stop reading
  };
  Status status = Status::end;
  RgbdFrame frame;
  Error error;
  int dropped = 0;              ///< frames that a live source discarded before this one
  bool is_reconnected = false;  ///< the camera was lost before this frame, or the recording began again: it
                                ///< may be elsewhere
};

/// Returns frames in order. Opened by openSource(); one thread at a time.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  [[nodiscard]] virtual const SourceInfo& info() const = 0;
  [[nodiscard]] virtual FrameRead next() = 0;
  /// Returns the next frame if it is ready; never waits.
  [[nodiscard]] virtual std::optional<FrameRead> nextIfReady() { return std::nullopt; }
};

/// User options for opening a source.
struct SourceOptions {
  int start = 0;              ///< skip this many frames of the recording
  int stride = 1;             ///< then take every stride-th
  std::optional<int> frames;  ///< maximum number
  int loops = 1;              ///< read the chosen part of the recording so often, see LoopedSource
  std::optional<Intrinsics>
      intrinsics;  ///< fx fy cx cy (width and height are the images'); overrides the source's
  std::optional<double> depth_scale;                    ///< units per metre; overrides the source's
  std::optional<ColorRegistration> color_registration;  ///< overrides the source's
  std::string depth_topic, color_topic;                 ///< of a ROS recording; empty: the only fitting pair
  /// Called once a second while opening takes longer than a second, with the part that is done (0 - 1).
  /// False cancels. Thread: that of openSource(). None: never cancelled.
  std::function<bool(double done)> on_opening = {};
};

}  // namespace scantrove
