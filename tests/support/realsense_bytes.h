#pragma once
#include <zlib.h>

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/support/zip_bytes.h"

namespace scantrove::test {

inline std::string floatBytes(const std::vector<float>& values) {
  std::string bytes;
  for (const float value : values) bytes += littleEndianBytes(std::bit_cast<std::uint32_t>(value), 4);
  return bytes;
}

/// A calibration table of a RealSense D4xx: its header of 16 bytes with the checksum of `content`, then it.
inline std::string realsenseTable(int type, const std::string& content) {
  const auto checksum =
      crc32(0, reinterpret_cast<const Bytef*>(content.data()), static_cast<uInt>(content.size()));
  return std::string("\x01\x02", 2) + littleEndianBytes(static_cast<std::uint64_t>(type), 2) +
         littleEndianBytes(content.size(), 4) + littleEndianBytes(0, 4) + littleEndianBytes(checksum, 4) +
         content;
}

/// The table of depth: intrinsics for 16 sizes after 240 bytes of the stereo pair, then 64 reserved bytes.
/// Entry 2 is for 640x480, entry 3 for 848x480.
inline std::string realsenseDepthTable(const std::array<float, 4>& vga, const std::array<float, 4>& wide) {
  std::string content(240, '\0');
  for (int i = 0; i < 16; ++i) {
    const std::array<float, 4>& K = i == 2 ? vga : wide;
    content += i == 2 || i == 3 ? floatBytes({K[0], K[1], K[2], K[3]}) : std::string(16, '\0');
  }
  return realsenseTable(25, content + std::string(64, '\0'));
}

/// What the table of the colour camera holds.
struct RealsenseColorTable {
  std::array<float, 4> normalized{1.44F, 2.56F, 0.01F, -0.02F};  ///< fx, fy, cx, cy; the image spans -1 to 1
  std::vector<float> lens{0, 0, 0, 0, 0};
  int width = 1920, height = 1080;                         ///< of the calibration
  std::vector<float> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< column by column
  std::vector<float> translation_mm{15, 0.2F, -0.1F};

  [[nodiscard]] std::string bytes() const {
    const auto& [fx, fy, cx, cy] = normalized;
    const auto side = [](int value) { return littleEndianBytes(static_cast<std::uint64_t>(value), 2); };
    return realsenseTable(32, floatBytes({fx, 0, cx, 0, fy, cy, 0, 0, 1}) + floatBytes(lens) +
                                  std::string(24 + 48, '\0') + side(width) + side(height) +
                                  std::string(36, '\0') + floatBytes(rotation) + floatBytes(translation_mm) +
                                  std::string(24, '\0'));
  }
};

/// The answer of a D4xx's hardware monitor: the operation, the data, and its size in the last four bytes.
inline std::string monitorAnswer(std::uint32_t operation, const std::string& data) {
  std::string answer = littleEndianBytes(operation, 4) + data;
  answer.resize(1020, '\0');
  return answer + littleEndianBytes(data.size(), 4);
}

}  // namespace scantrove::test
