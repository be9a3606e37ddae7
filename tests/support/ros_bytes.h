#pragma once
#include <array>
#include <cstdint>
#include <cstring>
#include <opencv2/core/mat.hpp>
#include <string>
#include <type_traits>
#include <vector>

namespace scantrove::test {

/// Serialises ROS messages after their definitions: ROS 1 without padding, ROS 2 as CDR, little-endian.
class RosBytes {
 public:
  explicit RosBytes(bool is_cdr) : is_cdr_(is_cdr) {}

  template <class Number>
  RosBytes& put(Number value) {
    static_assert(std::is_arithmetic_v<Number>);
    if (is_cdr_) bytes_.resize((bytes_.size() + sizeof value - 1) / sizeof value * sizeof value, '\0');
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  RosBytes& text(const std::string& text) {
    put(static_cast<std::uint32_t>(text.size() + (is_cdr_ ? 1 : 0)));
    bytes_ += text;
    if (is_cdr_) bytes_ += '\0';
    return *this;
  }
  RosBytes& list(const std::string& bytes) {
    put(static_cast<std::uint32_t>(bytes.size()));
    bytes_ += bytes;
    return *this;
  }
  RosBytes& header(std::int64_t stamp_ns, const std::string& frame) {
    if (!is_cdr_) put(std::uint32_t{0});
    put(static_cast<std::uint32_t>(stamp_ns / 1'000'000'000));
    put(static_cast<std::uint32_t>(stamp_ns % 1'000'000'000));
    return text(frame);
  }

  /// The message, with CDR's header.
  [[nodiscard]] std::string message() const { return is_cdr_ ? std::string("\0\1\0\0", 4) + bytes_ : bytes_; }

 private:
  bool is_cdr_;
  std::string bytes_;
};

inline std::string pixelBytes(const cv::Mat& image) {
  const cv::Mat whole = image.isContinuous() ? image : image.clone();
  return {reinterpret_cast<const char*>(whole.data), whole.total() * whole.elemSize()};
}

/// sensor_msgs/Image of `pixels` in their own order.
inline std::string rosImage(bool is_cdr, std::int64_t stamp_ns, const std::string& frame,
                            const std::string& encoding, const cv::Mat& pixels, bool is_big_endian = false) {
  return RosBytes(is_cdr)
      .header(stamp_ns, frame)
      .put(static_cast<std::uint32_t>(pixels.rows))
      .put(static_cast<std::uint32_t>(pixels.cols))
      .text(encoding)
      .put(static_cast<std::uint8_t>(is_big_endian))
      .put(static_cast<std::uint32_t>(static_cast<std::size_t>(pixels.cols) * pixels.elemSize()))
      .list(pixelBytes(pixels))
      .message();
}

inline std::string rosCompressedImage(bool is_cdr, std::int64_t stamp_ns, const std::string& frame,
                                      const std::string& format, const std::string& data) {
  return RosBytes(is_cdr).header(stamp_ns, frame).text(format).list(data).message();
}

/// sensor_msgs/CameraInfo of a camera without rotation; P has the same camera.
inline std::string rosCameraInfo(bool is_cdr, cv::Size size, const std::array<double, 4>& fx_fy_cx_cy,
                                 const std::string& model = "plumb_bob",
                                 const std::vector<double>& D = {0, 0, 0, 0, 0}) {
  const auto [fx, fy, cx, cy] = fx_fy_cx_cy;
  RosBytes info(is_cdr);
  info.header(0, "").put(static_cast<std::uint32_t>(size.height)).put(static_cast<std::uint32_t>(size.width));
  info.text(model).put(static_cast<std::uint32_t>(D.size()));
  for (const double value : D) info.put(value);
  for (const double value : {fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0}) info.put(value);
  for (const double value : {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}) info.put(value);
  for (const double value : {fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0}) info.put(value);
  info.put(std::uint32_t{0}).put(std::uint32_t{0});  // binning
  for (int i = 0; i < 4; ++i) info.put(std::uint32_t{0});
  return info.put(std::uint8_t{0}).message();
}

/// tf2_msgs/TFMessage of one transform: translation, then the quaternion x, y, z, w.
inline std::string rosTransforms(bool is_cdr, const std::string& parent, const std::string& child,
                                 const std::array<double, 7>& transform) {
  RosBytes message(is_cdr);
  message.put(std::uint32_t{1}).header(0, parent).text(child);
  for (const double value : transform) message.put(value);
  return message.message();
}

/// RVL (Wilson 2017): runs of zeros and of readings; differences with the sign in the lowest bit; groups of
/// three bits, the lowest first, in half bytes from the highest of 32-bit words on.
inline std::string rvlBytes(const cv::Mat& depth) {
  std::vector<std::uint32_t> nibbles;
  const auto putNumber = [&](std::uint32_t value) {
    do {
      const std::uint32_t rest = value >> 3;
      nibbles.push_back((value & 7U) | (rest != 0 ? 8U : 0U));
      value = rest;
    } while (value != 0);
  };
  const auto* const values = depth.ptr<std::uint16_t>();
  int last = 0;
  for (std::size_t at = 0; at < depth.total();) {
    std::size_t end = at;
    while (end < depth.total() && values[end] == 0) ++end;
    putNumber(static_cast<std::uint32_t>(end - at));
    at = end;
    while (end < depth.total() && values[end] != 0) ++end;
    putNumber(static_cast<std::uint32_t>(end - at));
    for (; at < end; ++at) {
      const int difference = int{values[at]} - last;
      putNumber(static_cast<std::uint32_t>(difference >= 0 ? 2 * difference : -2 * difference - 1));
      last = values[at];
    }
  }
  std::string bytes;
  for (std::size_t i = 0; i < nibbles.size(); i += 8) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 8; ++k) word = word << 4 | (i + k < nibbles.size() ? nibbles[i + k] : 0U);
    bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
  }
  return bytes;
}

}  // namespace scantrove::test
