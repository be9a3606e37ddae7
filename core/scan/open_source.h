#pragma once
#include <memory>
#include <string>

#include "core/base/result.h"
#include "core/capture/frame_source.h"

namespace scantrove {

/// What a live camera does when it is lost (unplugged, without frames).
enum class LostCamera {
  fails,    ///< FrameRead::Status::failed
  awaited,  ///< it is opened again when it returns; see ReconnectingSource
};

/// Opens the source named `source`, detecting its type: `demo` (tabletop), `demo:room`, `demo:room:SEED`,
/// `camera`, `camera:URI`, `freenect`, `freenect:INDEX`, `freenect:SERIAL` (a Kinect v1), `realsense`,
/// `realsense:SERIAL`, `realsense:/dev/videoN`, `record3d`, `record3d:UDID` (an iPhone), a recorded file
/// (.oni, .r3d, .sens, a ROS bag, a rosbag2 database, MCAP, an Azure Kinect's .mkv), a recording's folder
/// (see folder_formats.h). Recorded sources decode ahead on their own thread. Error: names the path, the
/// formats that were tried, and what to do.
[[nodiscard]] Result<std::unique_ptr<FrameSource>> openSource(const std::string& source,
                                                              const SourceOptions& options,
                                                              LostCamera lost = LostCamera::fails);

}  // namespace scantrove
