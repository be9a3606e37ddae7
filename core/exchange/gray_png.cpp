#include "core/exchange/gray_png.h"

#include <libdeflate.h>

#include <memory>
#include <new>
#include <string_view>
#include <vector>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
constexpr char kUp = 2;  // the filter: difference to the byte above
constexpr int kFastest = 1;

void appendBigEndian(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 0xff);
}

void appendChunk(std::string& png, std::string_view type, std::string_view content) {
  appendBigEndian(png, static_cast<std::uint32_t>(content.size()));
  const std::size_t first = png.size();
  png.append(type).append(content);
  appendBigEndian(png, libdeflate_crc32(0, png.data() + first, png.size() - first));
}

/// All rows, each behind the byte that names its filter.
std::vector<char> filterRows(const cv::Mat& image) {
  const auto columns = static_cast<std::size_t>(image.cols);
  std::vector<char> rows(static_cast<std::size_t>(image.rows) * (1 + 2 * columns));
  const std::vector<std::uint16_t> nothing(columns, 0);
  const std::uint16_t* above = nothing.data();
  char* out = rows.data();
  for (int y = 0; y < image.rows; ++y) {
    const auto* row = image.ptr<std::uint16_t>(y);
    *out++ = kUp;
    for (std::size_t x = 0; x < columns; ++x) {
      *out++ = static_cast<char>((row[x] >> 8) - (above[x] >> 8));
      *out++ = static_cast<char>((row[x] & 0xff) - (above[x] & 0xff));
    }
    above = row;
  }
  return rows;
}

std::string compress(const std::vector<char>& bytes) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kFastest), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  packed.resize(
      libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
  return packed;
}

}  // namespace

std::string encodeGrayPng(const cv::Mat& image) {
  SCANTROVE_CHECK(image.type() == CV_16UC1 && !image.empty());
  std::string header;
  appendBigEndian(header, static_cast<std::uint32_t>(image.cols));
  appendBigEndian(header, static_cast<std::uint32_t>(image.rows));
  header += {16, 0, 0, 0, 0};  // bits, grey, deflate, adaptive filters, not interlaced
  std::string png(kSignature);
  appendChunk(png, "IHDR", header);
  appendChunk(png, "IDAT", compress(filterRows(image)));
  appendChunk(png, "IEND", {});
  return png;
}

}  // namespace scantrove
