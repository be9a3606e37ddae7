#include "core/image/depth_png.h"

#include <libdeflate.h>

#include <algorithm>
#include <memory>
#include <string_view>
#include <vector>

#include "core/image/image_header.h"
#include "core/image/png_filters.h"

namespace scantrove {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kSignatureSize = 8;
constexpr std::size_t kChunkFrame = 12;  // length, type, checksum
constexpr std::size_t kHeaderEnd = kSignatureSize + kChunkFrame + 13;
constexpr std::size_t kWidthAt = 16;
constexpr std::size_t kHeightAt = 20;

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
  return is_grey_16 && is_plain && width > 0 && height > 0 && width <= kLongestImageSide_px &&
         height <= kLongestImageSide_px;
}

Result<cv::Mat> decodeDepthPng(Bytes bytes, const std::string& name) {
  const std::size_t width = bigEndian(bytes, kWidthAt);
  const std::size_t height = bigEndian(bytes, kHeightAt);
  const std::size_t row_size = width * kPngPixelSize;
  const std::vector<std::uint8_t> compressed = compressedPixels(bytes);
  std::vector<std::uint8_t> rows(height * (row_size + 1));  // each preceded by the number of its filter
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> inflater(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (compressed.empty() ||
      libdeflate_zlib_decompress(inflater.get(), compressed.data(), compressed.size(), rows.data(),
                                 rows.size(), nullptr) != LIBDEFLATE_SUCCESS) {
    return fail(name + " cannot be decoded: its pixels are damaged.");
  }
  if (!undoPngFilters(rows.data(), width, height)) {
    return fail(name + " cannot be decoded: a row has an unknown filter.");
  }
  cv::Mat image(static_cast<int>(height), static_cast<int>(width), CV_16UC1);
  for (std::size_t y = 0; y < height; ++y) {
    const std::uint8_t* const row = rows.data() + y * (row_size + 1) + 1;
    std::uint16_t* const pixels = image.ptr<std::uint16_t>(static_cast<int>(y));
    for (std::size_t x = 0; x < width; ++x) {
      pixels[x] = static_cast<std::uint16_t>(row[2 * x] << 8 | row[2 * x + 1]);
    }
  }
  return image;
}

}  // namespace scantrove
