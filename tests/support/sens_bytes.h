#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace scantrove::test {

/// `data` (at most 65535 bytes) as a zlib stream of one stored block (RFC 1950 and 1951).
inline std::string zlibStored(const std::string& data) {
  std::uint32_t a = 1, b = 0;  // Adler-32
  for (const char byte : data) {
    a = (a + static_cast<std::uint8_t>(byte)) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = static_cast<std::uint32_t>(data.size());
  std::string stream{"\x78\x01\x01", 3};
  for (const std::uint32_t value : {size & 0xFF, size >> 8, ~size & 0xFF, ~size >> 8 & 0xFF})
    stream += static_cast<char>(value);
  stream += data;
  for (const std::uint32_t sum : {b, a}) {
    stream += static_cast<char>(sum >> 8);
    stream += static_cast<char>(sum & 0xFF);
  }
  return stream;
}

/// The bytes of a value, little endian.
template <class T>
std::string sensNumber(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

/// A 4x4 matrix, row by row.
using SensMatrix = std::array<float, 16>;
inline constexpr SensMatrix kSensIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

inline std::string sensMatrix(const SensMatrix& matrix) {
  std::string bytes;
  for (const float value : matrix) bytes += sensNumber(value);
  return bytes;
}

inline SensMatrix sensCamera(float f, float cx, float cy) {
  return {f, 0, cx, 0, 0, f, cy, 0, 0, 0, 1, 0, 0, 0, 0, 1};
}

/// A frame of a .sens file; `color` and `depth` as stored.
struct SensFrameBytes {
  SensMatrix pose = kSensIdentity;
  std::uint64_t time = 0;
  std::string color, depth;
};

/// A .sens file of version 4.
struct SensFileBytes {
  std::uint32_t version = 4;
  std::string sensor = "StructureSensor";
  SensMatrix color_camera = sensCamera(120, 63.5F, 47.5F), depth_camera = sensCamera(60, 31.5F, 23.5F);
  SensMatrix T_rig_color = kSensIdentity;
  std::int32_t color_coding = 2, depth_coding = 1;  ///< JPEG (or PNG: 1), zlib
  std::uint32_t color_width = 128, color_height = 96, depth_width = 64, depth_height = 48;
  float units_per_meter = 1000;
  std::vector<SensFrameBytes> frames;

  [[nodiscard]] std::string bytes() const {
    std::string file = sensNumber(version) + sensNumber(std::uint64_t{sensor.size()}) + sensor;
    file += sensMatrix(color_camera) + sensMatrix(T_rig_color) + sensMatrix(depth_camera);
    file += sensMatrix(kSensIdentity) + sensNumber(color_coding) + sensNumber(depth_coding);
    for (const std::uint32_t side : {color_width, color_height, depth_width, depth_height})
      file += sensNumber(side);
    file += sensNumber(units_per_meter);
    file += sensNumber(std::uint64_t{frames.size()});
    for (const SensFrameBytes& frame : frames) {
      file += sensMatrix(frame.pose);
      for (const std::uint64_t number :
           {frame.time, frame.time, std::uint64_t{frame.color.size()}, std::uint64_t{frame.depth.size()}})
        file += sensNumber(number);
      file += frame.color + frame.depth;
    }
    return file;
  }
};

}  // namespace scantrove::test
