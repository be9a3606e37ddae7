#pragma once
#include <QByteArray>
#include <opencv2/core/mat.hpp>

namespace scantrove {

// Failures to encode (memory, or larger than decodedImage() accepts: image_header.h) throw std::exception.

/// A PNG file in memory (lossless: 8-bit 1 or 3 channels, 16-bit 1 channel); no bytes for an empty image.
[[nodiscard]] QByteArray toPng(const cv::Mat& image);

/// A JPEG file in memory, 8-bit BGR; no bytes for an empty image.
[[nodiscard]] QByteArray toJpeg(const cv::Mat& bgr);

/// Decodes an image from toPng() or toJpeg(). Empty for no bytes, for other data, and for a damaged or too
/// large image (image_header.h).
[[nodiscard]] cv::Mat decodedImage(const QByteArray& bytes);

}  // namespace scantrove
