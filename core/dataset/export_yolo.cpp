#include <spdlog/fmt/fmt.h>

#include <iterator>
#include <opencv2/core.hpp>
#include <set>
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
      : job_(job), categories_(job.scans().classes(), job.scans().chosen()) {}

  Result<void> beginScan() {
    instances_ = instancesOf(job_.chosen());
    addToLegend(legend_, legendOf(job_.chosen(), job_.scan().origin()), job_.part());
    return moveInto(split_, splitFrames(job_));
  }

  Result<void> add(const LabeledImage& image) {
    const DatasetSplit split = split_.of(image.frame.index);
    job_.counts().beginImage(split);
    used_.insert(split);
    const std::string part = splitName(split) + "/";
    SCANTROVE_TRY(job_.write("images/" + part + image.image_name, image.image_bytes));
    std::string lines;
    for (const ExportInstance& instance : instances_) {
      const cv::Mat mask = instance.maskIn(image);
      const auto outline = outlineOf(mask);
      if (outline.empty()) continue;
      lines += yoloLine(categories_.indexOf(instance), outline, mask.size());
      job_.counts().countMask(instance.class_name, cv::countNonZero(mask));
    }
    return job_.write("labels/" + part + image.stem + ".txt", lines);
  }

  Result<void> finish() {
    std::string yaml = "# " + onOneLine("Scantrove: " + job_.scans().title()) +
                       "\ntrain: images/train\nval: images/" +
                       (used_.contains(DatasetSplit::val) ? "val" : "train  # too few images for others") +
                       "\n" + (used_.contains(DatasetSplit::test) ? "test: images/test\n" : "") + "names:\n";
    for (std::size_t i = 0; i < categories_.all().size(); ++i)
      yaml += "  " + std::to_string(i) + ": " + yamlQuoted(categories_.all()[i].name) + "\n";
    SCANTROVE_TRY(job_.write("data.yaml", yaml));
    return job_.write("labels.json", jsonByLines(legend_));
  }

 private:
  ExportJob& job_;
  CategoryList categories_;
  std::vector<ExportInstance> instances_;
  FrameSplit split_;
  std::set<DatasetSplit> used_;
  ExportJson legend_ = ExportJson::object();
};

}  // namespace

Result<void> exportYolo(ExportJob& job) {
  SCANTROVE_TRY(job.needRegions());
  YoloSegments segments(job);
  const auto addScan = [&]() -> Result<void> {
    SCANTROVE_TRY(segments.beginScan());
    return forEachLabeledImage(job, true, [&](const LabeledImage& image) { return segments.add(image); });
  };
  SCANTROVE_TRY(job.forEachScan(addScan));
  return segments.finish();
}

}  // namespace scantrove
