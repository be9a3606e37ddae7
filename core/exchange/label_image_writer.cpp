#include "core/exchange/label_image_writer.h"

#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "core/base/check.h"
#include "core/base/regular_file.h"
#include "core/exchange/atomic_file.h"

namespace scantrove {
namespace {

/// For each output coordinate the input coordinate whose area holds its centre.
std::vector<int> nearestIndices(int from, int to) {
  std::vector<int> indices(static_cast<std::size_t>(to));
  for (int i = 0; i < to; ++i) {
    indices[static_cast<std::size_t>(i)] = static_cast<int>((2LL * i + 1) * from / (2LL * to));
  }
  return indices;
}

}  // namespace

Result<void> writeLabelImage(const std::filesystem::path& path, std::span<const std::uint32_t> labels,
                             int width, int height, cv::Size output_size) {
  SCANTROVE_CHECK(width > 0 && height > 0 &&
                  labels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  SCANTROVE_CHECK(output_size.width > 0 && output_size.height > 0);
  const std::vector<int> columns = nearestIndices(width, output_size.width);
  const std::vector<int> rows = nearestIndices(height, output_size.height);
  cv::Mat image(output_size, CV_16UC1);
  for (int y = 0; y < image.rows; ++y) {
    auto* out = image.ptr<std::uint16_t>(y);
    const std::uint32_t* in =
        labels.data() + static_cast<std::ptrdiff_t>(rows[static_cast<std::size_t>(y)]) * width;
    for (int x = 0; x < image.cols; ++x) {
      const std::uint32_t label = in[columns[static_cast<std::size_t>(x)]];
      if (label > std::numeric_limits<std::uint16_t>::max()) {
        return fail(
            "Cannot write " + path.string() + ": id " + std::to_string(label) + " does not fit into 16 bits.",
            "Scan a smaller part, or without --label-maps.");
      }
      out[x] = static_cast<std::uint16_t>(label);
    }
  }
  std::vector<unsigned char> png;
  try {
    cv::imencode(".png", image, png, {cv::IMWRITE_PNG_COMPRESSION, 1});
  } catch (const cv::Exception& error) {
    return fail("Cannot write " + path.string() + ": " + error.what());
  }
  return writeFileAtomically(path, std::string_view(reinterpret_cast<const char*>(png.data()), png.size()),
                             Durability::process);
}

Result<cv::Mat> readLabelImage(const std::filesystem::path& path) {
  SCANTROVE_TRY(checkRegularFile(path));
  cv::Mat image;
  try {
    image = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    return fail("Cannot read " + path.string() + ": " + error.what());
  }
  if (image.empty())
    return fail("Cannot read " + path.string() + " as an image.", "Label images are 16-bit PNGs.");
  if (image.type() == CV_8UC1) image.convertTo(image, CV_16UC1);
  if (image.type() != CV_16UC1) {
    return fail(path.string() + " is not a label image.", "Label images have one channel of 16 (or 8) bits.");
  }
  return image;
}

}  // namespace scantrove
