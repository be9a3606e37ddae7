#pragma once
#include <QByteArray>
#include <opencv2/core/mat.hpp>

namespace scantrove {

// What cannot be encoded (memory, or larger than decodedImage() takes: image_header.h) throws std::exception.

/// A PNG file in memory (lossless: 8-bit 1 or 3 channels, 16-bit 1 channel); no bytes for an empty image.
[[nodiscard]] QByteArray toPng(const cv::Mat& image);

/// A JPEG file in memory, 8-bit BGR; no bytes for an empty image.
[[nodiscard]] QByteArray toJpeg(const cv::Mat& bgr);

/// The image of a PNG or JPEG file in memory, as toPng() and toJpeg() had it; empty for no bytes, for bytes
/// that are no image, and for one that is damaged or too large (image_header.h).
[[nodiscard]] cv::Mat decodedImage(const QByteArray& bytes);

}  // namespace scantrove
