#include "core/exchange/label_image_writer.h"

#include <limits>
#include <string>

#include "core/base/check.h"
#include "core/exchange/atomic_file.h"
#include "core/image/image_file.h"
#include "core/image/png_encoder.h"

namespace scantrove {

Result<std::string> encodeLabelImage(const std::filesystem::path& path, std::span<const std::uint32_t> labels,
                                     cv::Size size) {
  SCANTROVE_CHECK(size.width > 0 && size.height > 0 &&
                  labels.size() == static_cast<std::size_t>(size.area()));
  cv::Mat image(size, CV_16UC1);
  auto* pixel = image.ptr<std::uint16_t>();
  for (const std::uint32_t label : labels) {
    if (label > std::numeric_limits<std::uint16_t>::max()) {
      return fail(
          "Cannot write " + path.string() + ": id " + std::to_string(label) + " does not fit into 16 bits.",
          "Scan a smaller part, or without --label-maps.");
    }
    *pixel++ = static_cast<std::uint16_t>(label);
  }
  return encodePng(image);
}

Result<void> writeLabelImage(const std::filesystem::path& path, std::span<const std::uint32_t> labels,
                             cv::Size size) {
  const Result<std::string> bytes = encodeLabelImage(path, labels, size);
  if (!bytes) return fail(bytes.error());
  return writeFileAtomically(path, *bytes, Durability::process);
}

Result<cv::Mat> readLabelImage(const std::filesystem::path& path) {
  Result<cv::Mat> read = readGrayImage(path);
  if (!read) return read;
  cv::Mat& image = *read;
  if (image.type() == CV_8UC1) image.convertTo(image, CV_16UC1);
  if (image.type() != CV_16UC1) {
    return fail(path.string() + " is not a label image.", "Label images have one channel of 16 (or 8) bits.");
  }
  return read;
}

}  // namespace scantrove
