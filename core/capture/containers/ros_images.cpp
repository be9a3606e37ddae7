#include "core/capture/containers/ros_images.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/capture/containers/rvl.h"
#include "core/capture/folder_listing.h"
#include "core/image/image_file.h"
#include "core/image/image_header.h"
#include "core/image/metric_depth.h"

namespace scantrove {

namespace {

constexpr int kNoConversion = -1;
constexpr std::size_t kCompressedDepthHeader = 12;  // the kind, and two floats of 32FC1

/// A colour encoding of sensor_msgs/Image, and OpenCV's conversion of it.
struct RosColorEncoding {
  const char* name;
  int type;
  int conversion;
};
constexpr std::array kRosColors{
    RosColorEncoding{"rgb8", CV_8UC3, cv::COLOR_RGB2BGR},
    RosColorEncoding{"bgr8", CV_8UC3, kNoConversion},
    RosColorEncoding{"8uc3", CV_8UC3, kNoConversion},
    RosColorEncoding{"rgba8", CV_8UC4, cv::COLOR_RGBA2BGR},
    RosColorEncoding{"bgra8", CV_8UC4, cv::COLOR_BGRA2BGR},
    RosColorEncoding{"yuv422", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
    RosColorEncoding{"uyvy", CV_8UC2, cv::COLOR_YUV2BGR_UYVY},
    RosColorEncoding{"yuv422_yuy2", CV_8UC2, cv::COLOR_YUV2BGR_YUY2},
    RosColorEncoding{"yuyv", CV_8UC2, cv::COLOR_YUV2BGR_YUY2},
    // OpenCV names a pattern by its second row.
    RosColorEncoding{"bayer_rggb8", CV_8UC1, cv::COLOR_BayerBG2BGR},
    RosColorEncoding{"bayer_bggr8", CV_8UC1, cv::COLOR_BayerRG2BGR},
    RosColorEncoding{"bayer_gbrg8", CV_8UC1, cv::COLOR_BayerGR2BGR},
    RosColorEncoding{"bayer_grbg8", CV_8UC1, cv::COLOR_BayerGB2BGR},
};

const RosColorEncoding* rosColorEncoding(const std::string& encoding) {
  const std::string lower = lowerCase(encoding);
  const auto found = std::ranges::find_if(kRosColors, [&](const auto& known) { return lower == known.name; });
  return found == kRosColors.end() ? nullptr : &*found;
}

bool isRosMetric(const std::string& encoding) { return lowerCase(encoding).starts_with("32fc1"); }

bool isRosSixteenBit(const std::string& encoding) {
  const std::string lower = lowerCase(encoding);
  return lower.starts_with("16uc1") || lower.starts_with("mono16") || lower.starts_with("z16");
}

bool isCompressedDepth(const std::string& format) {
  return lowerCase(format).find("compresseddepth") != std::string::npos;
}

bool isCompressedColor(const std::string& format) {
  const std::string lower = lowerCase(format);
  const bool is_gray = lower.starts_with("mono") || lower.starts_with("8uc1") || lower.starts_with("16") ||
                       lower.starts_with("32");
  return !is_gray && (lower.find("jp") != std::string::npos || lower.find("png") != std::string::npos);
}

tl::unexpected<Error> damagedMessage(const std::string& name) { return fail(name + " is damaged."); }

/// The pixels of an image message, not copied. Error: wrong sizes. OpenCV throws unless rows are whole
/// numbers apart.
Result<cv::Mat> pixelsOf(const RosImage& image, int type, const std::string& name) {
  SCANTROVE_TRY(checkImageSize({image.width, image.height}, name));
  const std::uint64_t row = std::uint64_t{image.width} * CV_ELEM_SIZE(type);
  if (image.step < row || image.step % CV_ELEM_SIZE1(type) != 0 ||
      std::uint64_t{image.step} * (image.height - 1) + row > image.data.size())
    return damagedMessage(name);
  // OpenCV takes pixels that it may change; they are only read.
  auto* const data = const_cast<std::uint8_t*>(image.data.data());
  return cv::Mat(static_cast<int>(image.height), static_cast<int>(image.width), type, data, image.step);
}

void swapBytes(cv::Mat& image) {
  const auto unit = static_cast<std::size_t>(image.elemSize1());
  for (int y = 0; y < image.rows; ++y) {
    std::uint8_t* const row = image.ptr(y);
    for (std::size_t x = 0; x < static_cast<std::size_t>(image.cols); ++x)
      std::reverse(row + x * unit, row + (x + 1) * unit);
  }
}

void removeSaturated(cv::Mat& depth) {
  for (int y = 0; y < depth.rows; ++y) {
    auto* const row = depth.ptr<std::uint16_t>(y);
    std::replace(row, row + depth.cols, std::uint16_t{UINT16_MAX}, std::uint16_t{0});
  }
}

std::uint16_t metricUnits(double meters) {
  const double units = std::floor(meters * kMetricUnitsPerMeter + 0.5);
  return units > 0 && units < UINT16_MAX ? static_cast<std::uint16_t>(units) : std::uint16_t{0};  // NaN: 0
}

/// compressed_depth_image_transport stores metres as z = a / (value - b).
void fromInverseDepth(cv::Mat& values, float a, float b) {
  for (int y = 0; y < values.rows; ++y) {
    auto* const row = values.ptr<std::uint16_t>(y);
    std::transform(row, row + values.cols, row, [&](std::uint16_t value) {
      return value == 0 ? value : metricUnits(static_cast<double>(a) / (value - static_cast<double>(b)));
    });
  }
}

Result<cv::Mat> decodeRawDepth(ByteView message, const MessageTopic& topic, const std::string& name) {
  const auto image = decodeRosImage(message, topic.encoding);
  if (!image) return damagedMessage(name);
  const bool is_metric = isRosMetric(image->encoding);
  if (!is_metric && !isRosSixteenBit(image->encoding)) {
    return fail(name + " is no depth image: its encoding is '" + image->encoding.substr(0, 20) + "'.");
  }
  const Result<cv::Mat> pixels = pixelsOf(*image, is_metric ? CV_32FC1 : CV_16UC1, name);
  if (!pixels) return pixels;
  cv::Mat copy = pixels->clone();
  if (image->is_big_endian) swapBytes(copy);
  if (is_metric) return toDepthUnits(copy, static_cast<float>(1 / kMetricUnitsPerMeter));
  removeSaturated(copy);
  return copy;
}

Result<cv::Mat> decodeRvlDepth(ByteView data, const std::string& name) {
  ByteCursor cursor(data);
  const auto columns = cursor.get<std::uint32_t>();
  const auto rows = cursor.get<std::uint32_t>();
  if (!cursor.isOk()) return damagedMessage(name);
  SCANTROVE_TRY(checkImageSize({columns, rows}, name));
  Result<cv::Mat> depth =
      decodeRvl(cursor.take(cursor.left()), {static_cast<int>(columns), static_cast<int>(rows)});
  if (!depth) return fail(name + " is damaged: " + depth.error().what + ".");
  removeSaturated(*depth);
  return depth;
}

Result<cv::Mat> decodeCompressedDepth(ByteView message, const MessageTopic& topic, const std::string& name) {
  const auto image = decodeRosCompressedImage(message, topic.encoding);
  if (!image) return damagedMessage(name);
  // Some drivers write the PNG alone.
  if (!isCompressedDepth(image->format) || imageFormat(image->data) == ImageFormat::png)
    return decodeDepthImage(image->data, name);
  ByteCursor cursor(image->data);
  cursor.skip(sizeof(std::uint32_t));
  const auto a = cursor.get<float>();
  const auto b = cursor.get<float>();
  if (!cursor.isOk()) return damagedMessage(name);
  const ByteView data = image->data.subspan(kCompressedDepthHeader);
  const bool is_rvl = lowerCase(image->format).find("rvl") != std::string::npos;
  Result<cv::Mat> depth = is_rvl ? decodeRvlDepth(data, name) : decodeDepthImage(data, name);
  if (depth && isRosMetric(image->format)) fromInverseDepth(*depth, a, b);
  return depth;
}

}  // namespace

std::optional<RosImageKind> rosImageKind(ByteView start, const MessageTopic& topic) {
  using Content = RosImageKind::Content;
  RosImageKind kind;
  if (topic.type == "sensor_msgs/Image") {
    const auto image = decodeRosImage(start, topic.encoding, false);
    if (!image) return std::nullopt;
    kind.header = image->header;
    kind.is_metric = isRosMetric(image->encoding);
    if (kind.is_metric || isRosSixteenBit(image->encoding)) kind.content = Content::depth;
    if (rosColorEncoding(image->encoding) != nullptr) kind.content = Content::color;
    return kind;
  }
  const auto image = decodeRosCompressedImage(start, topic.encoding, false);
  if (!image) return std::nullopt;
  kind.header = image->header;
  kind.is_metric = isRosMetric(image->format);
  if (isCompressedDepth(image->format) || isRosSixteenBit(image->format)) {
    kind.content = Content::depth;
  } else if (isCompressedColor(image->format)) {
    kind.content = Content::color;
  }
  return kind;
}

Result<cv::Mat> decodeRosDepth(ByteView message, const MessageTopic& topic, const std::string& name) {
  return topic.type == "sensor_msgs/Image" ? decodeRawDepth(message, topic, name)
                                           : decodeCompressedDepth(message, topic, name);
}

Result<cv::Mat> decodeRosColor(ByteView message, const MessageTopic& topic, const std::string& name) {
  if (topic.type != "sensor_msgs/Image") {
    const auto image = decodeRosCompressedImage(message, topic.encoding);
    return image ? decodeColorImage(image->data, name) : damagedMessage(name);
  }
  const auto image = decodeRosImage(message, topic.encoding);
  if (!image) return damagedMessage(name);
  const RosColorEncoding* const encoding = rosColorEncoding(image->encoding);
  if (encoding == nullptr) {
    return fail(name + " is no colour image: its encoding is '" + image->encoding.substr(0, 20) + "'.");
  }
  const Result<cv::Mat> pixels = pixelsOf(*image, encoding->type, name);
  if (!pixels) return pixels;
  if (encoding->conversion == kNoConversion) return pixels->clone();
  // Colour of YUV 4:2:2 and Bayer comes from pairs of columns or rows.
  constexpr int kLeastSide = 4;
  if (pixels->cols < kLeastSide || pixels->rows < kLeastSide || pixels->cols % 2 != 0)
    if (encoding->type == CV_8UC2 || encoding->type == CV_8UC1) return damagedMessage(name);
  cv::Mat color;
  cv::cvtColor(*pixels, color, encoding->conversion);
  return color;
}

}  // namespace scantrove
