#include "core/exchange/image_masks.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/base/check.h"

namespace scantrove {
namespace {

constexpr int kNotSampled = -1;

/// The column (or row) of a scaled image that takes its value from each one of the original.
std::vector<int> targetsOf(int original, int scaled) {
  std::vector<int> targets(static_cast<std::size_t>(original), kNotSampled);
  for (int target = 0; target < scaled; ++target) {
    const auto center = static_cast<std::size_t>((2LL * target + 1) * original / (2LL * scaled));
    targets[center] = target;
  }
  return targets;
}

}  // namespace

void RunBuilder::add(std::uint32_t position) {
  SCANTROVE_CHECK(position >= end_);
  if (runs_.empty() || position > end_) {
    runs_.push_back(position - end_);
    runs_.push_back(0);
  }
  ++runs_.back();
  end_ = position + 1;
}

MaskRuns RunBuilder::finish(std::uint32_t pixels) && {
  SCANTROVE_CHECK(pixels >= end_);
  if (pixels > end_ || runs_.empty()) runs_.push_back(pixels - end_);
  return std::move(runs_);
}

ImageMasks masksOf(const cv::Mat& labels) {
  SCANTROVE_CHECK(labels.type() == CV_16UC1);
  std::map<std::uint16_t, RunBuilder> builders;
  std::uint32_t position = 0;
  for (int x = 0; x < labels.cols; ++x) {
    for (int y = 0; y < labels.rows; ++y, ++position) {
      const std::uint16_t label = labels.at<std::uint16_t>(y, x);
      if (label != 0) builders[label].add(position);
    }
  }
  ImageMasks image{labels.size(), {}};
  for (auto& [label, builder] : builders) image.masks.push_back(std::move(builder).finish(position));
  return image;
}

std::vector<std::uint32_t> sampledPixels(const MaskRuns& mask, const cv::Size& size, const cv::Size& to) {
  SCANTROVE_CHECK(to.width > 0 && to.height > 0 && to.width <= size.width && to.height <= size.height);
  const std::vector<int> columns = targetsOf(size.width, to.width);
  const std::vector<int> rows = targetsOf(size.height, to.height);
  std::vector<std::uint32_t> pixels;
  std::size_t position = 0;
  for (std::size_t run = 0; run < mask.size(); ++run) {
    const std::size_t end = position + mask[run];
    for (; run % 2 == 1 && position < end; ++position) {
      const int column = columns[position / rows.size()], row = rows[position % rows.size()];
      if (column != kNotSampled && row != kNotSampled)
        pixels.push_back(static_cast<std::uint32_t>(row * to.width + column));
    }
    position = end;
  }
  std::ranges::sort(pixels);
  return pixels;
}

}  // namespace scantrove
