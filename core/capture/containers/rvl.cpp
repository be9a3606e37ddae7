#include "core/capture/containers/rvl.h"

#include <cstdint>

namespace scantrove {

namespace {

/// The half bytes of little-endian 32-bit words, the highest first.
class RvlNibbles {
 public:
  explicit RvlNibbles(ByteView bytes) : cursor_(bytes) {}

  [[nodiscard]] bool isOk() const { return cursor_.isOk(); }

  /// Three bits each, the lowest first; the fourth bit says that more follow.
  [[nodiscard]] std::uint32_t number() {
    constexpr int kMostBits = 30;
    std::uint32_t value = 0;
    for (int shift = 0; shift <= kMostBits; shift += 3) {
      const std::uint32_t nibble = next();
      value |= (nibble & 7U) << shift;
      if ((nibble & 8U) == 0) break;
    }
    return value;
  }

 private:
  std::uint32_t next() {
    if (left_ == 0) {
      word_ = cursor_.get<std::uint32_t>();
      left_ = 8;
    }
    --left_;
    return word_ >> 4 * left_ & 0xFU;
  }

  ByteCursor cursor_;
  std::uint32_t word_ = 0;
  std::uint32_t left_ = 0;
};

}  // namespace

/// Runs of zeros and of readings in turn; each reading is the difference to the one before, with the sign in
/// the lowest bit.
Result<cv::Mat> decodeRvl(ByteView bytes, const cv::Size& size) {
  RvlNibbles nibbles(bytes);
  cv::Mat depth(size, CV_16UC1, cv::Scalar(0));
  auto* const values = depth.ptr<std::uint16_t>();
  const std::size_t total = depth.total();
  std::uint32_t last = 0;
  for (std::size_t at = 0; at < total;) {
    const std::uint32_t zeros = nibbles.number();
    const std::uint32_t readings = nibbles.number();
    if (!nibbles.isOk() || zeros > total - at || readings > total - at - zeros || zeros + readings == 0)
      return fail("its RVL data are damaged");
    at += zeros;
    for (const std::size_t end = at + readings; at < end; ++at) {
      const std::uint32_t number = nibbles.number();
      last += number >> 1 ^ (0U - (number & 1U));
      values[at] = static_cast<std::uint16_t>(last);
    }
  }
  if (!nibbles.isOk()) return fail("its RVL data are cut");
  return depth;
}

}  // namespace scantrove
