#pragma once
#include "tests/support/container_bytes.h"
#include "tests/support/ros_bytes.h"

namespace scantrove::test {

/// A recording of one small frame with all messages that a reader looks at.
inline ContainerMessages smallRecording(bool is_cdr, bool is_compressed = false) {
  const cv::Mat depth(6, 8, CV_16UC1, cv::Scalar(1000)), color(6, 8, CV_8UC3, cv::Scalar(9, 8, 7));
  const std::string rvl =
      std::string(12, '\0') + raw(std::int32_t{8}) + raw(std::int32_t{6}) + rvlBytes(depth);
  const ContainerMessage depth_message =
      is_compressed
          ? ContainerMessage{"/d/image/compressedDepth", "sensor_msgs/CompressedImage", 5,
                             rosCompressedImage(is_cdr, 5, "d", "16UC1; compressedDepth rvl", rvl)}
          : ContainerMessage{"/d/image", "sensor_msgs/Image", 5, rosImage(is_cdr, 5, "d", "16UC1", depth)};
  const std::array<double, 7> right{0.02, 0, 0, 0, 0, 0, 1};
  return {{"/d/camera_info", "sensor_msgs/CameraInfo", 1, rosCameraInfo(is_cdr, {8, 6}, {8, 8, 4, 3})},
          {"/c/camera_info", "sensor_msgs/CameraInfo", 1, rosCameraInfo(is_cdr, {8, 6}, {8, 8, 4, 3})},
          {"/tf_static", "tf2_msgs/TFMessage", 1, rosTransforms(is_cdr, "d", "c", right)},
          depth_message,
          {"/c/image", "sensor_msgs/Image", 6, rosImage(is_cdr, 6, "c", "rgb8", color)}};
}

}  // namespace scantrove::test
