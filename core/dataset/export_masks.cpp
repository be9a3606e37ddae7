#include <cstdint>
#include <limits>
#include <map>
#include <opencv2/core.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/dataset/dataset_formats.h"
#include "core/dataset/key_frame_images.h"
#include "core/dataset/region_choice.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

using MaskNumbers = std::unordered_map<std::uint32_t, std::uint16_t>;

constexpr std::uint16_t kIgnoredNumber = std::numeric_limits<std::uint16_t>::max();

/// Numbers for the regions of a scan: their ids if these fit into 16 bits, else 1, 2, ... Several scans share
/// one sequence. Error: more regions than numbers.
class MaskNumbering {
 public:
  static Result<MaskNumbering> of(const ExportJob& job) {
    const ExportScans& scans = job.scans();
    const std::vector<LabeledRegion> regions = scans.chosen();
    // The largest number is for regions to ignore.
    constexpr std::uint32_t kMax = kIgnoredNumber - 1;
    if (regions.size() > kMax) {
      return fail(std::to_string(regions.size()) + " regions do not fit into masks of 16 bits.",
                  "Export coco instead, or without background (--background).");
    }
    const bool has_ids =
        !scans.isProject() && (regions.empty() || regions.back().id <= kMax);  // sorted by id
    return MaskNumbering(has_ids);
  }

  MaskNumbers numbersOf(const std::vector<LabeledRegion>& regions) {
    MaskNumbers numbers;
    for (const LabeledRegion& region : regions)
      numbers[region.id] = static_cast<std::uint16_t>(has_ids_ ? region.id : ++last_);
    return numbers;
  }

 private:
  explicit MaskNumbering(bool has_ids) : has_ids_(has_ids) {}

  bool has_ids_;
  std::uint32_t last_ = 0;
};

cv::Mat numberedMask(const cv::Mat& regions, const MaskNumbers& numbers) {
  cv::Mat mask = cv::Mat::zeros(regions.size(), CV_16UC1);
  for (int y = 0; y < regions.rows; ++y) {
    for (int x = 0; x < regions.cols; ++x) {
      const int region = regions.at<int>(y, x);
      if (region != 0) mask.at<std::uint16_t>(y, x) = numbers.at(static_cast<std::uint32_t>(region));
    }
  }
  return mask;
}

/// The data set under construction.
class MaskDataset {
 public:
  MaskDataset(ExportJob& job, MaskNumbering numbering) : job_(job), numbering_(numbering) {}

  void beginScan() {
    const DatasetPart& part = job_.part();
    numbers_ = numbering_.numbersOf(part.chosen);
    const ExportJson legend = legendOf(part.chosen, job_.scan().origin());
    for (const auto& [id, entry] : legend.items()) {
      ExportJson& added = labels_[std::to_string(numbers_.at(entry.at("region").get<std::uint32_t>()))];
      added = entry;
      if (!part.prefix.empty()) added["scan"] = validUtf8(part.name);
    }
  }

  Result<void> add(const LabeledImage& image) {
    if (!image.image_name.empty()) SCANTROVE_TRY(job_.write("color/" + image.image_name, image.image_bytes));
    for (const LabeledRegion& region : job_.chosen()) {
      const int pixels = cv::countNonZero(image.maskOf(region.id));
      if (pixels > 0) job_.counts().countMask(classOf(region), pixels);
    }
    cv::Mat mask = numberedMask(image.regions, numbers_);
    if (!image.ignored.empty()) mask.setTo(kIgnoredNumber, image.ignored);
    if (job_.part().split) lists_[*job_.part().split] += image.stem + "\n";
    return job_.write("masks/" + image.stem + ".png", encodePng(mask));
  }

  Result<void> finish() {
    for (const auto& [split, names] : lists_) SCANTROVE_TRY(job_.write(splitName(split) + ".txt", names));
    return job_.write("labels.json", jsonByLines(labels_));
  }

 private:
  ExportJob& job_;
  MaskNumbering numbering_;
  MaskNumbers numbers_;  // of the scan in work
  std::map<DatasetSplit, std::string> lists_;
  ExportJson labels_ = ExportJson::object();
};

}  // namespace

Result<void> exportMasks(ExportJob& job) {
  SCANTROVE_TRY(job.needRegions());
  const auto numbering = MaskNumbering::of(job);
  if (!numbering) return fail(numbering.error());
  MaskDataset dataset(job, *numbering);
  SCANTROVE_TRY(job.forEachScan([&] {
    dataset.beginScan();
    return forEachLabeledImage(job, false, [&](const LabeledImage& image) { return dataset.add(image); });
  }));
  return dataset.finish();
}

}  // namespace scantrove
