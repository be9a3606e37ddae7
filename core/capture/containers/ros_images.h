#pragma once
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/capture/containers/message_file.h"
#include "core/capture/containers/ros_messages.h"

namespace scantrove {

/// What an image topic holds, as its first message says.
struct RosImageKind {
  enum class Content { depth, color, other } content = Content::other;
  bool is_metric = false;  ///< depth in floating-point metres; decodeRosDepth gives kMetricUnitsPerMeter
  RosHeader header;
};

/// Bytes of a message that are enough for rosImageKind and decodeRosHeader.
inline constexpr std::size_t kRosStartBytes = 1024;

/// From the first kRosStartBytes of a message of type sensor_msgs/Image or sensor_msgs/CompressedImage. None:
/// damaged.
[[nodiscard]] std::optional<RosImageKind> rosImageKind(ByteView start, const MessageTopic& topic);

/// Decodes a depth message to CV_16UC1, 0 = no reading: 16UC1 and mono16 in their own units (65535 becomes
/// 0), 32FC1 in kMetricUnitsPerMeter, and both as PNG or RVL of compressed_depth_image_transport. Error:
/// names `name`; damaged, of another encoding, too large.
[[nodiscard]] Result<cv::Mat> decodeRosDepth(ByteView message, const MessageTopic& topic,
                                             const std::string& name);

/// Decodes a colour message to CV_8UC3, BGR: RGB, BGR, with alpha, YUV 4:2:2, Bayer, JPEG, PNG. Error: as
/// above.
[[nodiscard]] Result<cv::Mat> decodeRosColor(ByteView message, const MessageTopic& topic,
                                             const std::string& name);

}  // namespace scantrove
