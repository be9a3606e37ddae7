#include "core/catalog/image_blob.h"

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "core/base/check.h"

namespace scantrove {

QByteArray toPng(const cv::Mat& image) {
  // A PNG of size zero does not exist; an empty crop is stored as an empty (not null) blob.
  if (image.empty()) return QByteArray("");
  SCANTROVE_CHECK(image.type() == CV_8UC3 || image.type() == CV_8UC1 || image.type() == CV_16UC1);
  std::vector<unsigned char> bytes;
  // Level 1: crops are small and written while scanning.
  SCANTROVE_CHECK(cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1}));
  return {reinterpret_cast<const char*>(bytes.data()), static_cast<qsizetype>(bytes.size())};
}

cv::Mat fromPng(const QByteArray& bytes) {
  if (bytes.isEmpty()) return {};
  const cv::Mat raw(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.constData()));
  return cv::imdecode(raw, cv::IMREAD_UNCHANGED);
}

}  // namespace scantrove
