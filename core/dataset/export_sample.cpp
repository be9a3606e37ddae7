#include "core/dataset/export_sample.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/dataset/frame_choice.h"
#include "core/dataset/key_frame_images.h"
#include "core/dataset/region_choice.h"
#include "core/exchange/region_palette.h"

namespace scantrove {
namespace {

constexpr int kMaxWidth = 640;
constexpr double kMaskOpacity = 0.45;
constexpr double kFarthest_m = 5;  ///< shown as black if there is no colour image

/// Near depth is bright.
cv::Mat pictureOf(const cv::Mat& depth_m) {
  cv::Mat gray, picture;
  depth_m.convertTo(gray, CV_8U, -255 / kFarthest_m, 255);
  gray.setTo(0, depth_m <= 0);
  cv::cvtColor(gray, picture, cv::COLOR_GRAY2BGR);
  return picture;
}

cv::Vec3b colorOf(int region) {
  const Rgb rgb = regionColor(RegionId{static_cast<std::uint32_t>(region)});
  return {rgb[2], rgb[1], rgb[0]};
}

/// Fills each region transparently and draws its outline.
void drawMasks(const cv::Mat& regions, cv::Mat& picture) {
  for (int y = 0; y < regions.rows; ++y) {
    const auto* row = regions.ptr<int>(y);
    const auto* above = regions.ptr<int>(std::max(0, y - 1));
    const auto* below = regions.ptr<int>(std::min(regions.rows - 1, y + 1));
    auto* out = picture.ptr<cv::Vec3b>(y);
    for (int x = 0; x < regions.cols; ++x) {
      const int region = row[x];
      if (region == 0) continue;
      const int left = row[std::max(0, x - 1)], right = row[std::min(regions.cols - 1, x + 1)];
      const bool is_edge = left != region || right != region || above[x] != region || below[x] != region;
      const cv::Vec3b color = colorOf(region);
      for (int c = 0; c < 3; ++c) {
        out[x][c] =
            is_edge
                ? color[c]
                : cv::saturate_cast<std::uint8_t>(kMaskOpacity * color[c] + (1 - kMaskOpacity) * out[x][c]);
      }
    }
  }
}

cv::Mat pictureWithMasks(const KeyFrameImage& read) {
  const cv::Mat& regions = read.image.regions;
  const cv::Mat full = read.color.empty() ? pictureOf(read.image.depth_m) : read.color;
  const double scale = std::min(1.0, static_cast<double>(kMaxWidth) / regions.cols);
  cv::Mat picture, small;
  cv::resize(full, picture, {}, scale, scale, cv::INTER_AREA);
  cv::resize(regions, small, picture.size(), 0, 0, cv::INTER_NEAREST);
  drawMasks(small, picture);
  return picture;
}

}  // namespace

Result<ExportSample> sampleExport(LabeledScan& scan, const ExportOptions& options, std::optional<int> index) {
  ExportSample sample;
  if (!hasImages(options.format)) return sample;
  auto choice = chooseFrames(scan, options);
  if (!choice) return fail(choice.error());
  std::vector<KeyFrameInfo>* const frames = &choice->frames;
  const bool needs_color = options.format != DatasetFormat::masks;
  std::erase_if(*frames, [&](const KeyFrameInfo& frame) { return needs_color && frame.color_file.empty(); });
  sample.count = static_cast<int>(frames->size());
  if (frames->empty()) return sample;
  sample.index = std::clamp(index.value_or(sample.count / 2), 0, sample.count - 1);
  const KeyFrameInfo& frame = (*frames)[static_cast<std::size_t>(sample.index)];
  sample.frame = frame.index;
  auto read = readKeyFrameImage(scan, frame);
  if (!read) {
    sample.problem = read.error().what;
    return sample;
  }
  const auto regions = scan.regions();
  if (!regions) return fail(regions.error());
  SCANTROVE_TRY(
      labelImage(scan, *read, idsOf(chooseRegions(*regions, options.background, options.choices).exported)));
  sample.masks = static_cast<int>(visibleRegions(read->image.regions).size());
  sample.picture = pictureWithMasks(*read);
  return sample;
}

}  // namespace scantrove
