#include "core/image/png_encoder.h"

#include <libdeflate.h>

#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/check.h"
#include "core/image/image_header.h"

namespace scantrove {
namespace {

constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
constexpr std::uint8_t kUp = 2;  // the filter: difference to the byte above
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

/// As files have them: RGB, 16 bits with the higher byte first.
void copyAsStored(const cv::Mat& image, int y, std::span<std::uint8_t> row) {
  const std::uint8_t* from = image.ptr(y);
  const std::size_t step = image.elemSize();
  for (std::size_t i = 0; i < row.size(); ++i) row[i] = from[i - i % step + (step - 1 - i % step)];
}

/// All rows, each behind the byte that names its filter.
std::vector<std::uint8_t> filterRows(const cv::Mat& image) {
  const std::size_t row_bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
  std::vector<std::uint8_t> rows(static_cast<std::size_t>(image.rows) * (1 + row_bytes));
  std::vector<std::uint8_t> above(row_bytes, 0), row(row_bytes);
  std::uint8_t* out = rows.data();
  for (int y = 0; y < image.rows; ++y) {
    copyAsStored(image, y, row);
    *out++ = kUp;
    for (std::size_t i = 0; i < row_bytes; ++i) *out++ = static_cast<std::uint8_t>(row[i] - above[i]);
    std::swap(row, above);
  }
  return rows;
}

std::string compress(const std::vector<std::uint8_t>& bytes) {
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(kFastest), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  std::string packed(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()), '\0');
  packed.resize(
      libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), packed.data(), packed.size()));
  return packed;
}

}  // namespace

std::string encodePng(const cv::Mat& image) {
  SCANTROVE_CHECK((image.type() == CV_16UC1 || image.type() == CV_8UC1 || image.type() == CV_8UC3) &&
                  !image.empty());
  const ImageSize size{static_cast<std::uint32_t>(image.cols), static_cast<std::uint32_t>(image.rows)};
  if (const Result<void> fits = checkImageSize(size, "An image"); !fits)
    throw std::runtime_error(fits.error().message());
  std::string header;
  appendBigEndian(header, static_cast<std::uint32_t>(image.cols));
  appendBigEndian(header, static_cast<std::uint32_t>(image.rows));
  constexpr char kGrey = 0, kRgb = 2;
  const char bits = image.depth() == CV_16U ? 16 : 8;
  header +=
      {bits, image.channels() == 1 ? kGrey : kRgb, 0, 0, 0};  // deflate, adaptive filters, not interlaced
  std::string png(kSignature);
  appendChunk(png, "IHDR", header);
  appendChunk(png, "IDAT", compress(filterRows(image)));
  appendChunk(png, "IEND", {});
  return png;
}

}  // namespace scantrove
