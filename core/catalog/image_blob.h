#pragma once
#include <QByteArray>
#include <opencv2/core/mat.hpp>

namespace scantrove {

/// A PNG file in memory (lossless: 8-bit 1 or 3 channels, 16-bit 1 channel); no bytes for an empty image.
[[nodiscard]] QByteArray toPng(const cv::Mat& image);

/// The image of toPng's bytes, its type unchanged; empty for no bytes or for bytes that are no PNG.
[[nodiscard]] cv::Mat fromPng(const QByteArray& bytes);

}  // namespace scantrove
