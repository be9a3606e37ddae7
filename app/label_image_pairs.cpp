#include "app/label_image_pairs.h"

#include <charconv>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/exchange/label_image_writer.h"

namespace scantrove {
namespace {

namespace fs = std::filesystem;

std::optional<long> lastNumber(const std::string& name) {
  const auto is_digit = [&](std::size_t i) { return name[i] >= '0' && name[i] <= '9'; };
  std::size_t end = name.size();
  while (end > 0 && !is_digit(end - 1)) --end;
  std::size_t begin = end;
  while (begin > 0 && is_digit(begin - 1)) --begin;
  long number = 0;
  if (begin == end || std::from_chars(name.data() + begin, name.data() + end, number).ec != std::errc{}) {
    return std::nullopt;
  }
  return number;
}

Result<std::map<long, fs::path>> numberedImages(const fs::path& folder) {
  if (!fs::is_directory(folder))
    return fail(folder.string() + " is not a folder.", "Give folders of label PNGs.");
  std::map<long, fs::path> images;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const auto number = lastNumber(entry.path().stem().string());
    if (entry.path().extension() != ".png" || !number) continue;
    if (const auto [known, is_new] = images.emplace(*number, entry.path()); !is_new) {
      return fail(known->second.string() + " and " + entry.path().string() + " have the same number.",
                  "Give a folder with one label image a frame.");
    }
  }
  return images;
}

}  // namespace

Result<std::vector<LabelImagePair>> pairLabelImages(const fs::path& estimate, const fs::path& truth) {
  try {
    const auto estimates = numberedImages(estimate);
    if (!estimates) return fail(estimates.error());
    const auto truths = numberedImages(truth);
    if (!truths) return fail(truths.error());
    std::vector<LabelImagePair> pairs;
    for (const auto& [number, path] : *estimates) {
      if (const auto match = truths->find(number); match != truths->end())
        pairs.push_back({path, match->second});
    }
    if (pairs.empty()) {
      return fail(
          "No label image of " + estimate.string() + " has the number of one in " + truth.string() + ".",
          "Give two folders of PNGs named by frame, such as 000012.png.");
    }
    return pairs;
  } catch (const fs::filesystem_error& error) {
    return fail("Cannot read " + error.path1().string() + ": " + error.code().message() + ".");
  }
}

Result<SegmentationMetrics> evaluatePair(const LabelImagePair& pair,
                                         const SegmentationMetricOptions& options) {
  auto estimate = readLabelImage(pair.estimate);
  if (!estimate) return fail(estimate.error());
  const auto truth = readLabelImage(pair.truth);
  if (!truth) return fail(truth.error());
  if (estimate->size() != truth->size()) {
    cv::Mat resized;
    cv::resize(*estimate, resized, truth->size(), 0, 0, cv::INTER_NEAREST_EXACT);
    *estimate = resized;
  }
  return evaluateSegmentation(*estimate, *truth, options);
}

}  // namespace scantrove
