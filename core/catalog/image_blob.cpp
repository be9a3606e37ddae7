#include "core/catalog/image_blob.h"

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

namespace scantrove {
namespace {

constexpr std::uint64_t kMostPixels = 1ULL << 26U;

QByteArray encoded(const char* format, const cv::Mat& image, const std::vector<int>& options) {
  // An image file of size zero does not exist; an empty crop is stored as an empty (not null) blob.
  if (image.empty()) return QByteArray("");
  std::vector<unsigned char> bytes;
  if (!cv::imencode(format, image, bytes, options)) throw std::runtime_error("an image could not be encoded");
  return {reinterpret_cast<const char*>(bytes.data()), static_cast<qsizetype>(bytes.size())};
}

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

QByteArray toPng(const cv::Mat& image) {
  // Level 1: crops are small and written while scanning.
  return encoded(".png", image, {cv::IMWRITE_PNG_COMPRESSION, 1});
}

QByteArray toJpeg(const cv::Mat& bgr) { return encoded(".jpg", bgr, {cv::IMWRITE_JPEG_QUALITY, 90}); }

cv::Mat decodedImage(const QByteArray& bytes) {
  if (!isJpeg(bytes) && (!isPng(bytes) || claimsTooMuch(bytes))) return {};
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.constData()));
  try {
    return cv::imdecode(raw, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {  // sizes that the decoder itself refuses
    return {};
  }
}

}  // namespace scantrove
