#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "core/capture/containers/message_file.h"

namespace scantrove {

// What RealSense's SDK writes beside the images: topics /device_N/sensor_N/Depth_N/... of .bag and .db3.

/// Whether `topic` is an image topic of such a recording.
[[nodiscard]] bool isRealsenseTopic(const std::string& topic);

/// The depth unit in metres: the sensor's option "Depth Units", else that of the first image's metadata.
/// None: not in the file.
[[nodiscard]] std::optional<double> realsenseDepthUnit(MessageFile& file, const std::string& depth_topic);

/// T_color_depth. None: not in the file.
[[nodiscard]] std::optional<Eigen::Isometry3d> realsenseColorPlace(MessageFile& file,
                                                                   const std::string& depth_topic,
                                                                   const std::string& color_topic);

}  // namespace scantrove
