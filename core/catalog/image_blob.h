#pragma once
#include <QByteArray>
#include <opencv2/core/mat.hpp>

namespace scantrove {

// What cannot be encoded (memory, or more pixels in a row than a file can have) throws std::exception.

/// A PNG file in memory (lossless: 8-bit 1 or 3 channels, 16-bit 1 channel); no bytes for an empty image.
[[nodiscard]] QByteArray toPng(const cv::Mat& image);

/// A JPEG file in memory, 8-bit BGR; no bytes for an empty image.
[[nodiscard]] QByteArray toJpeg(const cv::Mat& bgr);

/// The image of a PNG or JPEG file in memory, its type unchanged; empty for no bytes and for bytes that are
/// no image or one of more than 2^26 pixels.
[[nodiscard]] cv::Mat decodedImage(const QByteArray& bytes);

}  // namespace scantrove
