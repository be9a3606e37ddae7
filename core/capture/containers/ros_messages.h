#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/capture/containers/byte_cursor.h"
#include "core/capture/containers/message_file.h"

namespace scantrove {

/// std_msgs/Header.
struct RosHeader {
  std::int64_t stamp_ns = 0;
  std::string frame;  ///< of the coordinate system
};

/// sensor_msgs/Image.
struct RosImage {
  RosHeader header;
  std::uint32_t width = 0, height = 0;
  std::string encoding;  ///< "16UC1", "rgb8", ...
  bool is_big_endian = false;
  std::uint32_t step = 0;  ///< bytes of a row
  ByteView data;           ///< points into the message
};

/// sensor_msgs/CompressedImage.
struct RosCompressedImage {
  RosHeader header;
  std::string format;  ///< "jpeg", "16UC1; compressedDepth", ...
  ByteView data;       ///< points into the message
};

/// sensor_msgs/CameraInfo.
struct RosCameraInfo {
  std::uint32_t width = 0, height = 0;
  std::string model;          ///< of the distortion: "plumb_bob", ...
  std::vector<double> D;      ///< at most 14
  std::array<double, 9> K{};  ///< row by row
  std::array<double, 12> P{};
};

/// geometry_msgs/TransformStamped.
struct RosTransform {
  std::string parent, child;
  Eigen::Isometry3d T_parent_child = Eigen::Isometry3d::Identity();
};

// Each decoder returns none if the message is damaged or of an unknown encoding.

[[nodiscard]] std::optional<RosHeader> decodeRosHeader(ByteView message, MessageEncoding encoding);
/// `has_data`: false for the start of a message, without its pixels.
[[nodiscard]] std::optional<RosImage> decodeRosImage(ByteView message, MessageEncoding encoding,
                                                     bool has_data = true);
[[nodiscard]] std::optional<RosCompressedImage> decodeRosCompressedImage(ByteView message,
                                                                         MessageEncoding encoding,
                                                                         bool has_data = true);
[[nodiscard]] std::optional<RosCameraInfo> decodeRosCameraInfo(ByteView message, MessageEncoding encoding);
/// std_msgs/Float32.
[[nodiscard]] std::optional<float> decodeRosFloat(ByteView message, MessageEncoding encoding);
/// std_msgs/String.
[[nodiscard]] std::optional<std::string> decodeRosString(ByteView message, MessageEncoding encoding);
/// geometry_msgs/Transform.
[[nodiscard]] std::optional<Eigen::Isometry3d> decodeRosTransform(ByteView message, MessageEncoding encoding);
/// tf2_msgs/TFMessage.
[[nodiscard]] std::optional<std::vector<RosTransform>> decodeRosTransforms(ByteView message,
                                                                           MessageEncoding encoding);

}  // namespace scantrove
