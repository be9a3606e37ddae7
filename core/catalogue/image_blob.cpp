#include "core/catalogue/image_blob.h"

#include <cstdint>
#include <span>
#include <string>

#include "core/image/image_header.h"
#include "core/image/jpeg_decoder.h"
#include "core/image/jpeg_encoder.h"
#include "core/image/png_decoder.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

constexpr const char* kName = "a picture";  // for errors that are not shown

/// An image file of size zero cannot exist; an empty crop is stored as an empty (not null) blob.
QByteArray blobOf(const std::string& bytes) { return {bytes.data(), static_cast<qsizetype>(bytes.size())}; }

}  // namespace

QByteArray toPng(const cv::Mat& image) { return image.empty() ? QByteArray("") : blobOf(encodePng(image)); }

QByteArray toJpeg(const cv::Mat& bgr) {
  constexpr int kQuality = 90;
  return bgr.empty() ? QByteArray("") : blobOf(encodeJpeg(bgr, kQuality));
}

cv::Mat decodedImage(const QByteArray& blob) {
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(blob.constData()),
                        static_cast<std::size_t>(blob.size()));
  const auto format = imageFormat(bytes);
  const auto size = imageSize(bytes);
  // A few bytes of a damaged image can claim any size, which would be allocated before the damage is
  // detected.
  if (!size || !checkImageSize(*size, kName)) return {};
  if (format == ImageFormat::jpeg) return decodeJpeg(bytes, kName).value_or(cv::Mat());
  return format == ImageFormat::png ? decodeAnyPng(bytes, kName).value_or(cv::Mat()) : cv::Mat();
}

}  // namespace scantrove
