#include "core/capture/image_file.h"

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mutex>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "core/capture/depth_png.h"
#include "core/capture/image_integrity.h"

namespace scantrove {

namespace {

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

Result<std::vector<std::uint8_t>> readBytes(const std::filesystem::path& path) {
  errno = 0;
  const std::unique_ptr<std::FILE, FileCloser> file(std::fopen(path.c_str(), "rb"));
  std::vector<std::uint8_t> bytes;
  if (file && std::fseek(file.get(), 0, SEEK_END) == 0) {
    const long size = std::ftell(file.get());
    std::rewind(file.get());
    // A folder opens too; its size is nonsense and reading it fails.
    if (size >= 0 && !std::filesystem::is_directory(path)) {
      bytes.resize(static_cast<std::size_t>(size));
      if (std::fread(bytes.data(), 1, bytes.size(), file.get()) == bytes.size()) {
        return bytes;
      }
    }
  }
  return fail(
      "Cannot read " + path.string() + ": " + (errno != 0 ? std::strerror(errno) : "not a file") + ".",
      "Check that it is there and its permissions.");
}

/// The edge where OpenCV's exceptions end.
Result<cv::Mat> decode(const std::filesystem::path& file, int flags) {
  static std::once_flag silenced;  // what OpenCV would print we say better ourselves
  std::call_once(silenced, [] { cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); });

  auto bytes = readBytes(file);
  if (!bytes) {
    return fail(bytes.error());
  }
  if (const std::string damage = findImageDamage(*bytes); !damage.empty()) {
    return fail(file.string() + " " + damage + ".");
  }
  if (flags == cv::IMREAD_UNCHANGED && isDepthPng(*bytes)) {
    return decodeDepthPng(*bytes, file.string());
  }
  try {
    if (cv::Mat image = cv::imdecode(*bytes, flags); !image.empty()) {
      return image;
    }
  } catch (const cv::Exception& exception) {
    return fail(file.string() + " cannot be decoded: " + exception.err + ".");
  }
  return fail(file.string() + " cannot be decoded: it is damaged or no image.");
}

std::string describe(const cv::Mat& image) {
  const char* const bits = image.depth() == CV_8U || image.depth() == CV_8S     ? "8-bit"
                           : image.depth() == CV_16U || image.depth() == CV_16S ? "16-bit"
                                                                                : "floating-point";
  return std::string(bits) + " with " + std::to_string(image.channels()) +
         (image.channels() == 1 ? " channel" : " channels");
}

}  // namespace

Result<cv::Mat> readColorImage(const std::filesystem::path& file) {
  return decode(file, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
}

Result<cv::Mat> readDepthImage(const std::filesystem::path& file) {
  auto image = decode(file, cv::IMREAD_UNCHANGED);
  if (!image) {
    return image;
  }
  if (image->type() != CV_16UC1) {
    return fail(file.string() + " is " + describe(*image) + "; depth images are 16-bit with 1 channel.",
                "Check that this is the depth folder and that the depth was saved as 16-bit PNG.");
  }
  for (int y = 0; y < image->rows; ++y) {
    std::uint16_t* const row = image->ptr<std::uint16_t>(y);
    for (int x = 0; x < image->cols; ++x) {
      row[x] = row[x] == UINT16_MAX ? std::uint16_t{0} : row[x];
    }
  }
  return image;
}

}  // namespace scantrove
