#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/capture/intrinsics.h"

namespace scantrove {

// The stream of the app Record3D over USB, as its maker's library (record3d) reads it: PeerTalk's header of
// four big-endian numbers, the last of which is the size of the message; then the message, little-endian.

/// Cuts the stream into messages. One thread.
class Record3dMessages {
 public:
  static constexpr std::size_t kMaxMessageBytes = std::size_t{32} << 20;

  void add(std::string_view bytes) { pending_.append(bytes); }

  /// The next complete message; none: more bytes are needed. Error: no such stream, or a message that is too
  /// large; what follows cannot be read.
  [[nodiscard]] Result<std::optional<std::string>> next();

 private:
  std::string pending_;
  std::size_t at_ = 0;  // of the next message in pending_
};

/// One frame of the stream.
struct Record3dFrame {
  cv::Mat color;          ///< CV_8UC3, BGR
  cv::Mat depth_m;        ///< CV_32FC1, z in metres, any value where there is none
  cv::Mat confidence;     ///< CV_8UC1, of depth's size, 0 - 2; empty: the device has none
  Intrinsics color_K;     ///< of the colour image
  bool is_lidar = false;  ///< else the camera for faces
  /// T_world_camera with Scantrove's camera axes. None: the message has none. The camera for faces has none.
  std::optional<Eigen::Isometry3d> pose;
};

/// Decodes a message. Error: truncated, damaged, or sizes that are impossible; names `name`.
[[nodiscard]] Result<Record3dFrame> decodeRecord3dMessage(std::string_view message, const std::string& name);

}  // namespace scantrove
