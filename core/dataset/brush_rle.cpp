#include "core/dataset/brush_rle.h"

#include <algorithm>
#include <array>
#include <utility>

namespace scantrove {
namespace {

constexpr unsigned kValueBits = 8, kChannels = 4;
constexpr std::array<unsigned, 4> kLengthBits{3, 4, 8, 16};
constexpr std::uint32_t kMaxLength = 1U << kLengthBits.back();

class BitWriter {
 public:
  /// Appends the lowest `bits` of `value`, highest first.
  void put(std::uint32_t value, unsigned bits) {
    for (unsigned i = bits; i-- > 0;) {
      if (free_bits_ == 0) {
        bytes_.push_back(0);
        free_bits_ = 8;
      }
      --free_bits_;
      bytes_.back() = static_cast<std::uint8_t>(bytes_.back() | (value >> i & 1U) << free_bits_);
    }
  }
  [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
  unsigned free_bits_ = 0;
};

void putRun(BitWriter& writer, std::uint32_t length, std::uint32_t value) {
  while (length > 0) {
    const std::uint32_t part = std::min(length, kMaxLength);
    std::uint32_t size = 0;
    while (part > 1U << kLengthBits[size]) ++size;
    writer.put(1, 1);
    writer.put(size, 2);
    writer.put(part - 1, kLengthBits[size]);
    writer.put(value, kValueBits);
    length -= part;
  }
}

}  // namespace

std::vector<std::uint8_t> brushRle(const cv::Mat& mask) {
  BitWriter writer;
  writer.put(static_cast<std::uint32_t>(mask.total()) * kChannels, 32);
  writer.put(kValueBits - 1, 5);
  for (const unsigned bits : kLengthBits) writer.put(bits - 1, 4);
  std::uint32_t length = 0;
  bool is_inside = false;
  for (int y = 0; y < mask.rows; ++y) {
    const auto* row = mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < mask.cols; ++x) {
      if ((row[x] != 0) != is_inside) {
        putRun(writer, length, is_inside ? 255 : 0);
        length = 0;
        is_inside = !is_inside;
      }
      length += kChannels;
    }
  }
  putRun(writer, length, is_inside ? 255 : 0);
  return writer.take();
}

}  // namespace scantrove
