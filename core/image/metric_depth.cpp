#include "core/image/metric_depth.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "core/base/regular_file.h"
#include "core/image/exr_image.h"
#include "core/image/image_file.h"
#include "core/image/numpy_image.h"

namespace scantrove {

namespace {

constexpr std::string_view kExrMagic = "\x76\x2F\x31\x01", kNumpyMagic = "\x93NUMPY";

Result<cv::Mat> decodeAny(const std::filesystem::path& file) {
  const auto start = readFile(file, kNumpyMagic.size());
  if (!start) return fail(start.error());
  if (start->starts_with(kExrMagic)) return readExrImage(file);
  if (*start == kNumpyMagic) return readNumpyImage(file);
  return readGrayImage(file);
}

}  // namespace

Result<cv::Mat> readMetricDepth(const std::filesystem::path& file) {
  auto image = decodeAny(file);
  if (!image) return image;
  if (image->channels() != 1 || (image->depth() != CV_32F && image->depth() != CV_64F)) {
    return fail(file.string() + " does not hold floating-point depth with 1 channel.",
                "Depth in metres is a float TIFF, an OpenEXR image or a NumPy array; depth in millimetres is "
                "a 16-bit PNG.");
  }
  cv::Mat1f metres;
  image->convertTo(metres, CV_32F);
  return withoutInvalidDepth(metres);
}

cv::Mat withoutInvalidDepth(const cv::Mat& metres) {
  cv::Mat1f valid = metres.clone();
  for (float& value : valid) {
    if (!std::isfinite(value) || value < 0) value = 0;
  }
  return valid;
}

cv::Mat toDepthUnits(const cv::Mat& metres, float meters_per_unit) {
  const double units_per_meter = 1.0 / static_cast<double>(meters_per_unit);
  cv::Mat1w depth(metres.size());
  for (int y = 0; y < metres.rows; ++y) {
    const float* const from = metres.ptr<float>(y);
    auto* const to = depth.ptr<std::uint16_t>(y);
    for (int x = 0; x < metres.cols; ++x) {
      const double units = std::round(static_cast<double>(from[x]) * units_per_meter);
      const bool is_in_range = units >= 0 && units <= std::numeric_limits<std::uint16_t>::max();
      to[x] = is_in_range ? static_cast<std::uint16_t>(units) : std::uint16_t{0};
    }
  }
  return depth;
}

}  // namespace scantrove
