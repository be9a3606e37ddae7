#include "core/editing/painted_pixels.h"

#include <algorithm>
#include <opencv2/core.hpp>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr unsigned kBitsOfByte = 7, kMoreFollows = 1U << kBitsOfByte;
/// A number of 32 bits has at most five bytes.
constexpr unsigned kMaxShift = 4 * kBitsOfByte;

/// Takes a number from the front of `bytes`; none: it has no end, or more than 32 bits.
std::optional<std::uint32_t> takeNumber(std::span<const char>& bytes) {
  std::uint64_t number = 0;
  for (unsigned shift = 0; shift <= kMaxShift; shift += kBitsOfByte) {
    if (bytes.empty()) return std::nullopt;
    const auto byte = static_cast<unsigned char>(bytes.front());
    bytes = bytes.subspan(1);
    number |= std::uint64_t{byte & (kMoreFollows - 1)} << shift;
    if ((byte & kMoreFollows) != 0) continue;
    return number <= UINT32_MAX ? std::optional(static_cast<std::uint32_t>(number)) : std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

PaintedPixels PaintedPixels::of(const cv::Mat& mask) {
  SCANTROVE_CHECK(mask.type() == CV_8UC1);
  PaintedPixels pixels{mask.cols, mask.rows, {}};
  bool is_painted = false;
  std::uint32_t length = 0;
  for (int y = 0; y < mask.rows; ++y) {
    const auto* row = mask.ptr(y);
    for (int x = 0; x < mask.cols; ++x, ++length) {
      if ((row[x] != 0) == is_painted) continue;
      pixels.runs.push_back(length);
      is_painted = !is_painted;
      length = 0;
    }
  }
  if (is_painted) pixels.runs.push_back(length);
  return pixels;
}

cv::Mat PaintedPixels::mask() const {
  cv::Mat mask = cv::Mat::zeros(height, width, CV_8UC1);
  auto* const pixels = mask.ptr();
  std::size_t position = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t end = std::min(position + runs[i], mask.total());
    if (i % 2 == 1) std::fill(pixels + position, pixels + end, std::uint8_t{255});
    position = end;
  }
  return mask;
}

std::string PaintedPixels::toBytes() const {
  std::string bytes;
  for (std::uint32_t run : runs) {
    for (; run >= kMoreFollows; run >>= kBitsOfByte)
      bytes.push_back(static_cast<char>((run & (kMoreFollows - 1)) | kMoreFollows));
    bytes.push_back(static_cast<char>(run));
  }
  return bytes;
}

std::optional<PaintedPixels> PaintedPixels::fromBytes(int width, int height, std::span<const char> bytes) {
  if (width <= 0 || height <= 0) return std::nullopt;
  PaintedPixels pixels{width, height, {}};
  std::uint64_t left = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  while (!bytes.empty()) {
    const std::optional<std::uint32_t> run = takeNumber(bytes);
    if (!run || *run > left || (*run == 0 && !pixels.runs.empty())) return std::nullopt;
    left -= *run;
    pixels.runs.push_back(*run);
  }
  return pixels.runs.size() % 2 == 0 ? std::optional(std::move(pixels)) : std::nullopt;
}

}  // namespace scantrove
