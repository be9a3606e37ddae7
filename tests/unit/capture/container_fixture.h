#pragma once
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/capture/open_input.h"
#include "tests/support/container_bytes.h"
#include "tests/support/ros_bytes.h"
#include "tests/support/temporary_folder.h"

namespace scantrove::test {

/// Depth of frame i, 0.4 - 4 m in millimetres, with holes.
inline cv::Mat containerDepth(int i, cv::Size size = {48, 36}) {
  cv::RNG random(static_cast<std::uint64_t>(100 + i));
  cv::Mat depth(size, CV_16UC1);
  random.fill(depth, cv::RNG::UNIFORM, 400, 4000);
  depth(cv::Rect(3, 2, 5, 4)).setTo(0);
  return depth;
}

inline cv::Mat containerColor(int i, cv::Size size = {48, 36}) {
  cv::RNG random(static_cast<std::uint64_t>(200 + i));
  cv::Mat color(size, CV_8UC3);
  random.fill(color, cv::RNG::UNIFORM, 0, 256);
  return color;
}

inline bool areEqual(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

inline constexpr std::int64_t kFirstStamp_ns = 1'700'000'000'000'000'000;
inline constexpr std::int64_t kInterval_ns = 33'333'333;
inline constexpr std::array<double, 4> kTestCamera{50, 51, 23.25, 17.5};

/// Five registered frames as a driver of ROS publishes them; colour comes 5 ms after depth, and is delivered
/// one frame late.
inline ContainerMessages registeredFrames(bool is_cdr, int count = 5) {
  ContainerMessages messages;
  messages.push_back({"/camera/depth/camera_info", "sensor_msgs/CameraInfo", kFirstStamp_ns,
                      rosCameraInfo(is_cdr, {48, 36}, kTestCamera)});
  for (int i = 0; i < count; ++i) {
    const std::int64_t stamp = kFirstStamp_ns + i * kInterval_ns, color_stamp = stamp + 5'000'000;
    messages.push_back({"/camera/depth/image_raw", "sensor_msgs/Image", stamp + 1'000'000,
                        rosImage(is_cdr, stamp, "optical", "16UC1", containerDepth(i))});
    messages.push_back({"/camera/color/image_raw", "sensor_msgs/Image", color_stamp + kInterval_ns,
                        rosImage(is_cdr, color_stamp, "optical", "bgr8", containerColor(i))});
  }
  return messages;
}

/// Opens and reads all frames. Fails the test if one is not usable.
inline std::vector<RgbdFrame> readAllFrames(const std::filesystem::path& file,
                                            const SourceOptions& options = {}) {
  std::vector<RgbdFrame> frames;
  const auto source = openInput(file.string(), options);
  if (!source) {
    ADD_FAILURE() << source.error().message();
    return frames;
  }
  for (FrameRead read = (*source)->next(); read.status != FrameRead::Status::end; read = (*source)->next()) {
    if (read.status != FrameRead::Status::frame) {
      ADD_FAILURE() << read.error.message();
      break;
    }
    frames.push_back(read.frame);
  }
  return frames;
}

inline std::string openContainerError(const std::filesystem::path& file, const SourceOptions& options = {}) {
  const auto source = openInput(file.string(), options);
  return source ? "opened" : source.error().message();
}

}  // namespace scantrove::test
