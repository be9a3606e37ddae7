#include "core/catalog/image_blob.h"

#include <cstdint>
#include <span>
#include <string>

#include "core/image/jpeg_decoder.h"
#include "core/image/jpeg_encoder.h"
#include "core/image/png_decoder.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

constexpr std::uint64_t kMostPixels = 1ULL << 26U;

/// An image file of size zero does not exist; an empty crop is stored as an empty (not null) blob.
QByteArray blobOf(const std::string& bytes) { return {bytes.data(), static_cast<qsizetype>(bytes.size())}; }

bool isPng(const QByteArray& bytes) { return bytes.startsWith("\x89PNG\r\n\x1a\n") && bytes.size() > 24; }
bool isJpeg(const QByteArray& bytes) { return bytes.startsWith("\xff\xd8\xff"); }

/// A few bytes of a damaged PNG can claim any size, which would be allocated before the damage is noticed.
bool claimsTooMuch(const QByteArray& bytes) {
  const auto number = [&](qsizetype at) {
    std::uint64_t value = 0;
    for (qsizetype i = at; i < at + 4; ++i) value = 256 * value + static_cast<std::uint8_t>(bytes[i]);
    return value;
  };
  return number(16) * number(20) > kMostPixels;
}

}  // namespace

QByteArray toPng(const cv::Mat& image) { return image.empty() ? QByteArray("") : blobOf(encodePng(image)); }

QByteArray toJpeg(const cv::Mat& bgr) {
  constexpr int kQuality = 90;
  return bgr.empty() ? QByteArray("") : blobOf(encodeJpeg(bgr, kQuality));
}

cv::Mat decodedImage(const QByteArray& blob) {
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(blob.constData()),
                        static_cast<std::size_t>(blob.size()));
  if (isJpeg(blob)) return decodeJpeg(bytes, "a picture").value_or(cv::Mat());
  if (!isPng(blob) || claimsTooMuch(blob)) return {};
  return decodeAnyPng(bytes, "a picture").value_or(cv::Mat());
}

}  // namespace scantrove
