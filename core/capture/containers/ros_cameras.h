#pragma once
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/capture/containers/message_file.h"
#include "core/capture/containers/ros_messages.h"
#include "core/capture/intrinsics.h"
#include "core/capture/lens_distortion.h"

namespace scantrove {

/// A camera of a ROS recording.
struct RosCamera {
  Intrinsics K;  ///< width and height 0: images of any size
  std::optional<LensDistortion> lens;
};

/// The camera that a message of `info` describes: sensor_msgs/CameraInfo, or RealSense's std_msgs/String of
/// KEY=VALUE. Images of `image_topic` whose name contains "rect" are undistorted already: P, no lens. A lens
/// of another model than Brown's or the rational one is ignored with a warning. None: no such message, or
/// without focal lengths.
[[nodiscard]] std::optional<RosCamera> readRosCamera(MessageFile& file, const MessageTopic& info,
                                                     const std::string& image_topic);

/// T_TO_FROM: takes points of the coordinate system `from` to those of `to`, by the first messages of
/// /tf_static and /tf. None: they are not connected.
[[nodiscard]] std::optional<Eigen::Isometry3d> readRosTransform(MessageFile& file, const std::string& to,
                                                                const std::string& from);

/// Name of a coordinate system without the slash that older versions wrote before it.
[[nodiscard]] std::string rosFrameName(const std::string& frame);

}  // namespace scantrove
