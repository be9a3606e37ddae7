#include <spdlog/fmt/fmt.h>

#include <iterator>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "core/dataset/category_list.h"
#include "core/dataset/dataset_formats.h"
#include "core/dataset/export_instances.h"
#include "core/dataset/frame_split.h"
#include "core/dataset/key_frame_images.h"
#include "core/dataset/mask_outline.h"
#include "core/dataset/region_choice.h"

namespace scantrove {
namespace {

/// Offset of a corner into its pixel, so that truncating and rounding programs find the same pixel.
constexpr double kWithinPixel = 0.25;

/// One line for each instance: its class, then x and y of the corners as fractions of the image's size.
std::string yoloLine(std::size_t class_index, const std::vector<cv::Point>& outline, const cv::Size& size) {
  std::string line = std::to_string(class_index);
  for (const cv::Point& point : outline) {
    fmt::format_to(std::back_inserter(line), " {:.6f} {:.6f}", (point.x + kWithinPixel) / size.width,
                   (point.y + kWithinPixel) / size.height);
  }
  return line + "\n";
}

/// The data set under construction.
class YoloSegments {
 public:
  explicit YoloSegments(ExportJob& job)
      : job_(job), categories_(job.scan().classes(), job.chosen()), instances_(instancesOf(job.chosen())) {}

  Result<void> chooseValidation() { return moveInto(split_, splitFrames(job_)); }

  Result<void> add(const LabeledImage& image) {
    const std::string part = split_.training.contains(image.frame.index) ? "train/" : "val/";
    SCANTROVE_TRY(job_.write("images/" + part + image.image_name, image.image_bytes));
    std::string lines;
    for (const ExportInstance& instance : instances_) {
      const cv::Mat mask = instance.maskIn(image);
      const auto outline = outlineOf(mask);
      if (outline.empty()) continue;
      lines += yoloLine(categories_.indexOf(instance), outline, mask.size());
      job_.countMask(instance.class_name, cv::countNonZero(mask));
    }
    return job_.write("labels/" + part + image.stem + ".txt", lines);
  }

  Result<void> finish() {
    std::string yaml = "# " + onOneLine("Scantrove: " + job_.scan().name()) +
                       "\ntrain: images/train\nval: images/" +
                       (split_.has_validation ? "val" : "train  # too few images for others") + "\nnames:\n";
    for (std::size_t i = 0; i < categories_.all().size(); ++i)
      yaml += "  " + std::to_string(i) + ": " + yamlQuoted(categories_.all()[i].name) + "\n";
    SCANTROVE_TRY(job_.write("data.yaml", yaml));
    return job_.write("labels.json", jsonByLines(legendOf(job_.chosen(), job_.scan().origin())));
  }

 private:
  ExportJob& job_;
  CategoryList categories_;
  std::vector<ExportInstance> instances_;
  FrameSplit split_;
};

}  // namespace

Result<void> exportYolo(ExportJob& job) {
  SCANTROVE_TRY(job.needRegions());
  YoloSegments segments(job);
  SCANTROVE_TRY(segments.chooseValidation());
  SCANTROVE_TRY(
      forEachLabeledImage(job, true, [&](const LabeledImage& image) { return segments.add(image); }));
  return segments.finish();
}

}  // namespace scantrove
