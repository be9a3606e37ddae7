#include "app/label_images.h"

#include <opencv2/imgproc.hpp>

#include "core/base/text.h"
#include "core/exchange/label_image_writer.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

/// Whether `record` writes images with this name.
bool isRecordedImage(const std::string& name) {
  return name.starts_with("frame-") &&
         (name.ends_with(".color.png") || name.ends_with(".depth.png") || name.ends_with(".instance.png"));
}

}  // namespace

Result<NumberedImages> numberedImages(const fs::path& folder) {
  try {
    if (!fs::is_directory(folder)) {
      return fail(folder.string() + " is not a folder.", "Give folders of label PNGs.");
    }
    NumberedImages images;
    NumberedImages instances;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      const auto number = lastNumber(entry.path().stem().string());
      if (entry.path().extension() != ".png" || !number) continue;
      if (name.starts_with("frame-") && name.ends_with(".instance.png"))
        instances.emplace(*number, entry.path());
      if (isRecordedImage(name)) continue;
      if (const auto [known, is_new] = images.emplace(*number, entry.path()); !is_new) {
        return fail(known->second.string() + " and " + entry.path().string() + " have the same number.",
                    "Give a folder with one label image a frame.");
      }
    }
    return instances.empty() ? images : instances;
  } catch (const fs::filesystem_error& error) {
    return fail("Cannot read " + error.path1().string() + ": " + error.code().message() + ".");
  }
}

Result<SegmentationMetrics> evaluateLabelImage(const fs::path& path, const cv::Mat& truth,
                                               const SegmentationMetricOptions& options) {
  auto labels = readLabelImage(path);
  if (!labels) return fail(labels.error());
  if (labels->size() != truth.size()) {
    cv::Mat resized;
    cv::resize(*labels, resized, truth.size(), 0, 0, cv::INTER_NEAREST_EXACT);
    *labels = resized;
  }
  return evaluateSegmentation(*labels, truth, options);
}

}  // namespace scantrove
