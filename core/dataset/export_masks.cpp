#include <cstdint>
#include <limits>
#include <opencv2/core.hpp>
#include <unordered_map>

#include "core/dataset/dataset_formats.h"
#include "core/dataset/key_frame_images.h"
#include "core/dataset/region_choice.h"
#include "core/image/png_encoder.h"

namespace scantrove {
namespace {

using MaskNumbers = std::unordered_map<std::uint32_t, std::uint16_t>;

/// Region ids if they fit into 16 bits, else 1, 2, ... Error: more regions than numbers.
Result<MaskNumbers> numberRegions(const std::vector<LabeledRegion>& regions) {
  constexpr std::uint32_t kMax = std::numeric_limits<std::uint16_t>::max();
  if (regions.size() > kMax) {
    return fail(std::to_string(regions.size()) + " regions do not fit into masks of 16 bits.",
                "Export coco instead, or without --background.");
  }
  const bool fit = regions.empty() || regions.back().id <= kMax;  // sorted by id
  MaskNumbers numbers;
  for (std::size_t i = 0; i < regions.size(); ++i)
    numbers[regions[i].id] = static_cast<std::uint16_t>(fit ? regions[i].id : i + 1);
  return numbers;
}

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

}  // namespace

Result<void> exportMasks(ExportJob& job) {
  SCANTROVE_TRY(job.needRegions());
  const auto numbers = numberRegions(job.chosen());
  if (!numbers) return fail(numbers.error());
  const auto writeOne = [&](const LabeledImage& image) -> Result<void> {
    if (!image.image_name.empty()) SCANTROVE_TRY(job.write("color/" + image.image_name, image.image_bytes));
    for (const LabeledRegion& region : job.chosen()) {
      const int pixels = cv::countNonZero(image.maskOf(region.id));
      if (pixels > 0) job.countMask(classOf(region), pixels);
    }
    return job.write("masks/" + image.stem + ".png", encodePng(numberedMask(image.regions, *numbers)));
  };
  SCANTROVE_TRY(forEachLabeledImage(job, false, writeOne));
  const ExportJson legend = legendOf(job.chosen(), job.scan().origin());
  ExportJson labels = ExportJson::object();
  for (const auto& [id, entry] : legend.items())
    labels[std::to_string(numbers->at(entry.at("region").get<std::uint32_t>()))] = entry;
  return job.write("labels.json", jsonByLines(labels));
}

}  // namespace scantrove
