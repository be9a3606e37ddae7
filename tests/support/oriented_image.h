#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace scantrove::test {

inline std::string encoded(const std::string& extension, const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension, image, bytes);
  return {bytes.begin(), bytes.end()};
}

/// The image as decoded by programs that apply the orientation.
inline cv::Mat decodeUpright(const std::string& bytes) {
  return cv::imdecode(std::vector<std::uint8_t>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
}

/// The JPEG with another segment after its start.
inline std::string withSegment(const std::string& jpeg, char marker, const std::string& content) {
  const std::size_t length = content.size() + 2;
  return jpeg.substr(0, 2) + '\xFF' + marker + static_cast<char>(length >> 8U) +
         static_cast<char>(length & 0xFFU) + content + jpeg.substr(2);
}

/// A TIFF directory of Exif: maker and orientation.
inline std::string exifDirectory(bool is_big_endian, int orientation) {
  std::string text = is_big_endian ? "MM" : "II";
  const auto put = [&](unsigned value, int bytes) {
    for (int i = 0; i < bytes; ++i)
      text += static_cast<char>(value >> static_cast<unsigned>(8 * (is_big_endian ? bytes - 1 - i : i)));
  };
  put(42, 2), put(8, 4), put(2, 2);
  put(0x010F, 2), put(2, 2), put(4, 4), text += std::string("Abc\0", 4);
  put(0x0112, 2), put(3, 2), put(1, 4), put(static_cast<unsigned>(orientation), 2), put(0, 2);
  put(0, 4);
  return text;
}

inline std::string withExif(const std::string& jpeg, bool is_big_endian, int orientation) {
  return withSegment(jpeg, '\xE1', std::string("Exif\0\0", 6) + exifDirectory(is_big_endian, orientation));
}

}  // namespace scantrove::test
