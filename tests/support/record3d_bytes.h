#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/zip_bytes.h"

namespace scantrove::test {

/// A frame of the app Record3D as it is sent over USB.
struct Record3dBytes {
  int color_width = 8, color_height = 6;
  int depth_width = 4, depth_height = 3;
  std::string color;                                  ///< a compressed image; empty: a grey PNM
  std::vector<float> depth_m;                         ///< empty: 1.5 everywhere
  std::string confidence;                             ///< a byte a pixel; empty: the device has none
  std::string other = "{}";                           ///< what the app adds
  std::uint32_t device = 1;                           ///< 0: the camera for faces, 1: LiDAR
  std::array<float, 4> intrinsics{8, 8, 3.5F, 2.5F};  ///< of the colour image
  std::array<float, 7> pose{0, 0, 0, 1, 0, 0, 0};     ///< qx, qy, qz, qw, x, y, z

  /// Eleven numbers, the intrinsics, the pose, then the images.
  [[nodiscard]] std::string message() const {
    std::string depth_bytes;
    const auto pixels = static_cast<std::size_t>(depth_width * depth_height);
    for (const float depth : depth_m.empty() ? std::vector<float>(pixels, 1.5F) : depth_m)
      depth_bytes += of(depth);
    const std::string depth = storedLzfse(depth_bytes);
    const std::string packed_confidence = confidence.empty() ? "" : storedLzfse(confidence);
    const std::string image = color.empty() ? grayImage() : color;
    std::string bytes;
    for (const int side : {color_width, color_height, depth_width, depth_height,
                           confidence.empty() ? 0 : depth_width, confidence.empty() ? 0 : depth_height})
      bytes += of(static_cast<std::uint64_t>(side));
    for (const std::size_t size : {image.size(), depth.size(), packed_confidence.size(), other.size()})
      bytes += of(size);
    bytes += of(std::uint64_t{device});
    for (const float value : intrinsics) bytes += of(value);
    for (const float value : pose) bytes += of(value);
    return bytes + image + depth + packed_confidence + other;
  }

  /// A message behind PeerTalk's header: version, kind, tag and size, big-endian.
  [[nodiscard]] static std::string peerTalk(const std::string& message) {
    std::string header(std::string("\0\0\0\1\0\0\0\x65\0\0\0\0", 12));
    for (int shift = 24; shift >= 0; shift -= 8) header += static_cast<char>(message.size() >> shift & 0xFFU);
    return header + message;
  }
  [[nodiscard]] std::string bytes() const { return peerTalk(message()); }

 private:
  static std::string of(std::uint64_t value) { return littleEndianBytes(value, 4); }
  static std::string of(float value) { return littleEndianBytes(std::bit_cast<std::uint32_t>(value), 4); }
  [[nodiscard]] std::string grayImage() const {
    const auto size = static_cast<std::size_t>(3 * color_width * color_height);
    return "P6 " + std::to_string(color_width) + " " + std::to_string(color_height) + " 255\n" +
           std::string(size, 'd');
  }
};

}  // namespace scantrove::test
