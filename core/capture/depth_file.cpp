#include "core/capture/depth_file.h"

#include <cstdint>
#include <string_view>

#include "core/base/regular_file.h"
#include "core/image/image_file.h"
#include "core/image/metric_depth.h"
#include "core/image/numpy_image.h"

namespace scantrove {
namespace {

constexpr std::string_view kExrStart = "\x76\x2F\x31\x01", kNumpyStart = "\x93NUMPY";

bool isTiffStart(std::string_view start) {
  using namespace std::string_view_literals;
  return start.starts_with("II*\0"sv) || start.starts_with("MM\0*"sv);
}

bool isFloatImage(const cv::Mat& image) { return image.depth() == CV_32F || image.depth() == CV_64F; }

Result<cv::Mat> readNumpyDepth(const std::filesystem::path& file) {
  auto image = readNumpyImage(file);
  if (!image) return image;
  if (isFloatImage(*image)) return readMetricDepth(file);
  if (image->type() != CV_16UC1)
    return fail(file.string() + " is an array of 8-bit numbers, which are no depths.",
                "Save h x w arrays of uint16, float16, float32 or float64.");
  image->setTo(0, *image == UINT16_MAX);
  return image;
}

}  // namespace

Result<cv::Mat> readAnyDepth(const std::filesystem::path& file) {
  const auto start = readFile(file, kNumpyStart.size());
  if (!start) return fail(start.error());
  if (start->starts_with(kExrStart)) return readMetricDepth(file);
  if (*start == kNumpyStart) return readNumpyDepth(file);
  if (isTiffStart(*start)) {
    const auto image = readGrayImage(file);
    if (!image) return image;
    if (isFloatImage(*image)) return readMetricDepth(file);
  }
  return readDepthImage(file);
}

}  // namespace scantrove
