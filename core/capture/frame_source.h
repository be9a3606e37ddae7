#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/capture/color_camera.h"
#include "core/capture/instance_name.h"
#include "core/capture/intrinsics.h"
#include "core/capture/rgbd_frame.h"

namespace scantrove {

/// What is known of a source once it is open.
struct SourceInfo {
  std::string name;  ///< for people: the folder's name, the camera's name
  std::string kind;  ///< "7-Scenes", "TUM RGB-D", "numbered images", "OpenNI2 camera", "OpenNI2 recording",
                     ///< "libfreenect camera", "synthetic"
  Intrinsics intrinsics;
  std::optional<int> frame_count;  ///< frames that next() will give in all; empty for a live camera
  bool is_live = false;
  bool has_poses = false;
  std::vector<InstanceName> instances;  ///< of the masks in RgbdFrame::instances, where there are some
};

/// What one call of FrameSource::next() gave.
struct FrameRead {
  enum class Status {
    frame,    ///< `frame` is filled
    skipped,  ///< one frame could not be used (truncated image, NaN pose); `error` says why; go on reading
    timeout,  ///< a live camera gave nothing for a second; go on reading
    end,      ///< the recording is over
    failed,   ///< the source is gone (unplugged, folder removed); `error` says why; stop reading
  };
  Status status = Status::end;
  RgbdFrame frame;
  Error error;
  int dropped = 0;  ///< frames a live source threw away before this one
};

/// Gives frames one after the other. Opened by openSource(); used from one thread at a time.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  [[nodiscard]] virtual const SourceInfo& info() const = 0;
  [[nodiscard]] virtual FrameRead next() = 0;
  /// The same if it is there already: never waits.
  [[nodiscard]] virtual std::optional<FrameRead> nextIfReady() { return std::nullopt; }
};

/// What a person may say about a source when opening it.
struct SourceOptions {
  int start = 0;              ///< skip this many frames of the recording
  int stride = 1;             ///< then take every stride-th
  std::optional<int> frames;  ///< at most so many
  std::optional<Intrinsics>
      intrinsics;  ///< fx fy cx cy (width and height are the images'); overrides the source's
  std::optional<double> depth_scale;                    ///< units per metre; overrides the source's
  std::optional<ColorRegistration> color_registration;  ///< overrides the source's
};

}  // namespace scantrove
