#include <spdlog/fmt/fmt.h>

#include <cstdint>
#include <iterator>
#include <map>
#include <opencv2/core.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/dataset/category_list.h"
#include "core/dataset/dataset_formats.h"
#include "core/dataset/key_frame_images.h"
#include "core/dataset/mask_outline.h"
#include "core/dataset/region_choice.h"

namespace scantrove {
namespace {

/// Offset of a corner into its pixel, so that truncating and rounding programs find the same pixel.
constexpr double kWithinPixel = 0.25;
constexpr int kMinForValidation = 5;

/// One instance: an object of the catalogue with all its regions, or a region without object.
struct Instance {
  std::size_t category = 0;  ///< index into CategoryList::all()
  std::vector<std::uint32_t> regions;

  /// CV_8UC1, 255 = the instance.
  [[nodiscard]] cv::Mat maskIn(const LabeledImage& image) const {
    cv::Mat mask = image.maskOf(regions.front());
    for (std::size_t i = 1; i < regions.size(); ++i) mask |= image.maskOf(regions[i]);
    return mask;
  }
};

/// In the order of their first regions.
std::vector<Instance> instancesOf(const std::vector<LabeledRegion>& regions, const CategoryList& categories) {
  std::vector<Instance> instances;
  std::map<std::int64_t, std::size_t> of_object;
  for (const LabeledRegion& region : regions) {
    const std::size_t next = instances.size();
    const std::size_t place =
        region.object ? of_object.try_emplace(*region.object, next).first->second : next;
    if (place == next) instances.push_back({categories.indexOf(region), {}});
    instances[place].regions.push_back(region.id);
  }
  return instances;
}

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
      : job_(job),
        categories_(job.scan().classes(), job.chosen()),
        instances_(instancesOf(job.chosen(), categories_)) {}

  Result<void> chooseValidation() {
    const auto frames = framesToExport(job_, true);
    if (!frames) return fail(frames.error());
    std::vector<int> usable;
    for (const KeyFrameInfo& frame : *frames) usable.push_back(frame.index);
    const auto training =
        usable.size() < kMinForValidation ? usable.size() : usable.size() - usable.size() / 5;
    training_.insert(usable.begin(), usable.begin() + static_cast<std::ptrdiff_t>(training));
    has_validation_ = training < usable.size();
    return {};
  }

  Result<void> add(const LabeledImage& image) {
    const std::string part = training_.contains(image.frame.index) ? "train/" : "val/";
    SCANTROVE_TRY(job_.write("images/" + part + image.image_name, image.image_bytes));
    std::string lines;
    for (const Instance& instance : instances_) {
      const cv::Mat mask = instance.maskIn(image);
      const auto outline = outlineOf(mask);
      if (outline.empty()) continue;
      lines += yoloLine(instance.category, outline, mask.size());
      ++job_.summary().annotations;
    }
    return job_.write("labels/" + part + image.stem + ".txt", lines);
  }

  Result<void> finish() {
    std::string yaml = "# " + onOneLine("Scantrove: " + job_.scan().name()) +
                       "\ntrain: images/train\nval: images/" +
                       (has_validation_ ? "val" : "train  # too few images for others") + "\nnames:\n";
    for (std::size_t i = 0; i < categories_.all().size(); ++i)
      yaml += "  " + std::to_string(i) + ": " + yamlQuoted(categories_.all()[i].name) + "\n";
    SCANTROVE_TRY(job_.write("data.yaml", yaml));
    return job_.write("labels.json", jsonByLines(legendOf(job_.chosen(), job_.scan().origin())));
  }

 private:
  ExportJob& job_;
  CategoryList categories_;
  std::vector<Instance> instances_;
  std::set<int> training_;
  bool has_validation_ = false;
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
