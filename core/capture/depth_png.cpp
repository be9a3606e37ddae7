#include "core/capture/depth_png.h"

#include <libdeflate.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <vector>

namespace scantrove {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kSignatureSize = 8;
constexpr std::size_t kChunkFrame = 12;  // length, type, checksum
constexpr std::size_t kHeaderEnd = kSignatureSize + kChunkFrame + 13;
constexpr std::size_t kWidthAt = 16;
constexpr std::size_t kHeightAt = 20;
constexpr std::uint32_t kLargestSide_px = 8192;
constexpr std::size_t kPixelSize = 2;

std::uint32_t bigEndian(Bytes bytes, std::size_t at) {
  return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 |
         std::uint32_t{bytes[at + 2]} << 8 | std::uint32_t{bytes[at + 3]};
}

bool isType(Bytes bytes, std::size_t at, std::string_view type) {
  return std::equal(type.begin(), type.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

/// The contents of all IDAT chunks in one piece; empty if a checksum is wrong.
std::vector<std::uint8_t> compressedPixels(Bytes bytes) {
  std::vector<std::uint8_t> data;
  std::size_t at = kSignatureSize;
  while (bytes.size() - at >= kChunkFrame) {
    const std::size_t length = bigEndian(bytes, at);
    if (length > bytes.size() - at - kChunkFrame) {
      break;
    }
    if (isType(bytes, at + 4, "IDAT")) {
      const Bytes content = bytes.subspan(at + 8, length);
      if (libdeflate_crc32(0, bytes.data() + at + 4, length + 4) != bigEndian(bytes, at + 8 + length)) {
        return {};
      }
      data.insert(data.end(), content.begin(), content.end());
    }
    at += kChunkFrame + length;
  }
  return data;
}

/// Which of the three predicts best. Without branches: in noisy depth the choice is as good as random, and
/// half of a decoder's time would go into wrongly guessed jumps.
int paeth(int left, int up, int up_left) {
  const int to_left = up - up_left;
  const int to_up = left - up_left;
  const int from_left = std::abs(to_left);
  const int from_up = std::abs(to_up);
  const int from_up_left = std::abs(to_left + to_up);
  const int not_left = -static_cast<int>((from_left > from_up) | (from_left > from_up_left));
  const int not_up = -static_cast<int>(from_up > from_up_left);
  const int other = (up & ~not_up) | (up_left & not_up);
  return (left & ~not_left) | (other & not_left);
}

/// Undoes one row's filter in place (PNG specification, 9.2). `up` is the row above, zeros for the first. The
/// first pixel has zeros on its left.
bool unfilter(int filter, std::uint8_t* row, const std::uint8_t* up, std::size_t size) {
  const auto add = [row](std::size_t i, int value) { row[i] = static_cast<std::uint8_t>(row[i] + value); };
  switch (filter) {
    case 0:
      return true;
    case 1:
      for (std::size_t i = kPixelSize; i < size; ++i) {
        add(i, row[i - kPixelSize]);
      }
      return true;
    case 2:
      for (std::size_t i = 0; i < size; ++i) {
        add(i, up[i]);
      }
      return true;
    case 3:
      for (std::size_t i = 0; i < size; ++i) {
        add(i, ((i < kPixelSize ? 0 : row[i - kPixelSize]) + up[i]) / 2);
      }
      return true;
    case 4: {
      // The two bytes of a pixel are separate chains of dependences; in registers they run side by side.
      int high = 0, high_up_left = 0, low = 0, low_up_left = 0;
      for (std::size_t i = 0; i + 1 < size; i += kPixelSize) {
        const int high_up = up[i];
        const int low_up = up[i + 1];
        high = (row[i] + paeth(high, high_up, high_up_left)) & 0xFF;
        low = (row[i + 1] + paeth(low, low_up, low_up_left)) & 0xFF;
        row[i] = static_cast<std::uint8_t>(high);
        row[i + 1] = static_cast<std::uint8_t>(low);
        high_up_left = high_up;
        low_up_left = low_up;
      }
      return true;
    }
    default:
      return false;
  }
}

}  // namespace

bool isDepthPng(Bytes bytes) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1A\n";
  constexpr std::size_t kBits = kHeightAt + 4;  // bits, colour type, compression, filter, interlace
  if (bytes.size() < kHeaderEnd ||
      !std::equal(kSignature.begin(), kSignature.end(), bytes.begin(),
                  [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }) ||
      !isType(bytes, 12, "IHDR")) {
    return false;
  }
  const std::uint32_t width = bigEndian(bytes, kWidthAt);
  const std::uint32_t height = bigEndian(bytes, kHeightAt);
  const bool is_grey_16 = bytes[kBits] == 16 && bytes[kBits + 1] == 0;
  const bool is_plain = bytes[kBits + 2] == 0 && bytes[kBits + 3] == 0 && bytes[kBits + 4] == 0;
  return is_grey_16 && is_plain && width > 0 && height > 0 && width <= kLargestSide_px &&
         height <= kLargestSide_px;
}

Result<cv::Mat> decodeDepthPng(Bytes bytes, const std::string& name) {
  const std::size_t width = bigEndian(bytes, kWidthAt);
  const std::size_t height = bigEndian(bytes, kHeightAt);
  const std::size_t row_size = width * kPixelSize;
  const std::vector<std::uint8_t> compressed = compressedPixels(bytes);
  std::vector<std::uint8_t> rows(height * (row_size + 1));  // each preceded by the number of its filter
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflater(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (compressed.empty() ||
      libdeflate_zlib_decompress(inflater.get(), compressed.data(), compressed.size(), rows.data(),
                                 rows.size(), nullptr) != LIBDEFLATE_SUCCESS) {
    return fail(name + " cannot be decoded: its pixels are damaged.");
  }
  cv::Mat image(static_cast<int>(height), static_cast<int>(width), CV_16UC1);
  const std::vector<std::uint8_t> zeros(row_size);
  const std::uint8_t* up = zeros.data();
  for (std::size_t y = 0; y < height; ++y) {
    std::uint8_t* const row = rows.data() + y * (row_size + 1) + 1;
    if (!unfilter(row[-1], row, up, row_size)) {
      return fail(name + " cannot be decoded: row " + std::to_string(y) + " has an unknown filter.");
    }
    up = row;
    std::uint16_t* const pixels = image.ptr<std::uint16_t>(static_cast<int>(y));
    for (std::size_t x = 0; x < width; ++x) {
      pixels[x] = static_cast<std::uint16_t>(row[2 * x] << 8 | row[2 * x + 1]);
    }
  }
  return image;
}

}  // namespace scantrove
