#include "core/image/image_file.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <span>
#include <vector>

#include "core/base/regular_file.h"
#include "core/image/image_header.h"
#include "core/image/jpeg_decoder.h"
#include "core/image/png_decoder.h"

namespace scantrove {

namespace {

using Bytes = std::span<const std::uint8_t>;

Bytes bytesOf(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Refuses images that are too large before reading them completely.
Result<std::string> readImageBytes(const std::filesystem::path& file) {
  auto start = readFile(file, kImageHeaderBytes);
  if (!start) {
    return start;
  }
  if (const auto size = imageSize(bytesOf(*start))) {
    SCANTROVE_TRY(checkImageSize(*size, file.string()));
  }
  if (start->size() < kImageHeaderBytes) return start;
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{512}
                                        << 20;  // three times the largest without compression
  std::error_code unknown;                      // readFile() says why
  const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
  if (!unknown && bytes > kMostBytes) return fail(file.string() + " is larger than 512 MB.");
  return readFile(file, kMostBytes);
}

using Decode = Result<cv::Mat>(Bytes bytes, const std::string& name);

Result<cv::Mat> readImage(const std::filesystem::path& file, Decode& decode) {
  const auto bytes = readImageBytes(file);
  return bytes ? decode(bytesOf(*bytes), file.string()) : fail(bytes.error());
}

/// Returns the format after checks that precede decoding.
Result<ImageFormat> checkImage(Bytes bytes, const std::string& name) {
  if (bytes.empty()) return fail(name + " is empty.");
  const auto format = imageFormat(bytes);
  const auto size = imageSize(bytes);
  if (!format || !size) {
    return fail(name + " cannot be decoded: it is damaged, truncated or no image.",
                "Images are PNG, JPEG, PPM, PGM, BMP or TIFF files.");
  }
  SCANTROVE_TRY(checkImageSize(*size, name));
  if (bytes.size() < leastImageBytes(bytes))
    return fail(name + " is truncated (" + std::to_string(bytes.size()) + " bytes).");
  return *format;
}

/// Decodes with OpenCV. `flags`: cv::ImreadModes.
Result<cv::Mat> decodeOther(Bytes bytes, int flags, const std::string& name) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  std::vector<std::uint8_t> copy(bytes.begin(), bytes.end());
  // OpenCV ends a number of a text PNM at the next blank, which may be missing at the end of the file.
  const bool is_text = bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '3';
  if (is_text) copy.push_back('\n');
  std::string reason;
  try {
    cv::Mat image = cv::imdecode(copy, flags);
    if (!image.empty()) return image;
  } catch (const std::exception& exception) {
    reason = std::string(" (") + exception.what() + ")";
  }
  return fail(name + " cannot be decoded: it is damaged or truncated" + reason + ".");
}

std::string describe(const cv::Mat& image) {
  const char* const bits = image.depth() == CV_8U || image.depth() == CV_8S     ? "8-bit"
                           : image.depth() == CV_16U || image.depth() == CV_16S ? "16-bit"
                                                                                : "floating-point";
  return std::string(bits) + " with " + std::to_string(image.channels()) +
         (image.channels() == 1 ? " channel" : " channels");
}

}  // namespace

Result<cv::Mat> decodeGrayImage(Bytes bytes, const std::string& name) {
  const auto format = checkImage(bytes, name);
  if (!format) return fail(format.error());
  if (*format == ImageFormat::png) return decodeGrayPng(bytes, name);
  return *format == ImageFormat::jpeg ? decodeJpeg(bytes, name)
                                      : decodeOther(bytes, cv::IMREAD_UNCHANGED, name);
}

Result<cv::Mat> decodeColorImage(Bytes bytes, const std::string& name) {
  const auto format = checkImage(bytes, name);
  if (!format) return fail(format.error());
  if (*format == ImageFormat::png) return decodeColorPng(bytes, name);
  return *format == ImageFormat::jpeg
             ? decodeJpeg(bytes, name)
             : decodeOther(bytes, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION, name);
}

Result<cv::Mat> decodeDepthImage(Bytes bytes, const std::string& name) {
  auto image = decodeGrayImage(bytes, name);
  if (!image) {
    return image;
  }
  if (image->type() != CV_16UC1) {
    return fail(name + " is " + describe(*image) + "; depth images are 16-bit with 1 channel.",
                "Check that this is the depth folder and that the depth was saved as 16-bit PNG.");
  }
  for (int y = 0; y < image->rows; ++y) {
    auto* const row = image->ptr<std::uint16_t>(y);
    std::replace(row, row + image->cols, std::uint16_t{UINT16_MAX}, std::uint16_t{0});
  }
  return image;
}

Result<cv::Mat> readColorImage(const std::filesystem::path& file) {
  return readImage(file, decodeColorImage);
}

Result<cv::Mat> readGrayImage(const std::filesystem::path& file) { return readImage(file, decodeGrayImage); }

Result<cv::Mat> readDepthImage(const std::filesystem::path& file) {
  return readImage(file, decodeDepthImage);
}

}  // namespace scantrove
