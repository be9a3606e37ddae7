#include "ui/view/scene_pointing.h"

#include <algorithm>
#include <opencv2/core.hpp>

namespace scantrove {
namespace {

constexpr double kIdsPerPixel = 0.5;  ///< resolution of the id picture
constexpr int kGapPasses = 2;
// Fine search near region borders: a pixel may show several points of the cloud, so it is divided into
// kPartsOfPixel, and kFineRadius parts on each side are drawn.
constexpr int kPartsOfPixel = 3;
constexpr int kFineRadius = 2 * kPartsOfPixel;

/// Fills gaps between points of a coarse cloud with the region on both sides.
void closeGaps(cv::Mat& ids) {
  const cv::Mat open = ids.clone();
  for (int y = 1; y + 1 < ids.rows; ++y) {
    const auto* above = open.ptr<int>(y - 1);
    const auto* row = open.ptr<int>(y);
    const auto* below = open.ptr<int>(y + 1);
    auto* out = ids.ptr<int>(y);
    for (int x = 1; x + 1 < ids.cols; ++x) {
      if (row[x] != 0) continue;
      if (row[x - 1] != 0 && row[x - 1] == row[x + 1]) {
        out[x] = row[x - 1];
      } else if (above[x] != 0 && above[x] == below[x]) {
        out[x] = above[x];
      } else if (above[x - 1] != 0 && above[x - 1] == below[x + 1]) {
        out[x] = above[x - 1];
      } else if (above[x + 1] != 0 && above[x + 1] == below[x - 1]) {
        out[x] = above[x + 1];
      }
    }
  }
}

}  // namespace

void ScenePointing::setDrawn(const QSize& pixels, double ratio) {
  pixels_ = pixels;
  ratio_ = ratio;
  is_outdated_ = true;
}

const cv::Mat& ScenePointing::regionIds() {
  if (!is_outdated_) return full_.regions;
  is_outdated_ = false;
  scene_.drawIds(pixels_.width(), pixels_.height(), static_cast<float>(kIdsPerPixel / ratio_), full_.ids);
  findRegions(full_);
  return full_.regions;
}

void ScenePointing::findRegions(Picture& picture) const {
  const CloudIds& ids = picture.ids;
  picture.regions.create(ids.height(), ids.width(), CV_32SC1);
  std::transform(
      ids.fragments().begin(), ids.fragments().end(), picture.regions.begin<int>(),
      [this](FragmentId fragment) { return static_cast<int>(scene_.cloud().regionOf(fragment).value); });
  for (int pass = 0; pass < kGapPasses; ++pass) closeGaps(picture.regions);
}

RegionPoint ScenePointing::at(const QPointF& fraction) {
  const cv::Mat& ids = regionIds();
  if (ids.empty()) return {};
  const int x = static_cast<int>(fraction.x() * ids.cols);
  const int y = static_cast<int>(fraction.y() * ids.rows);
  if (fraction.x() < 0 || fraction.y() < 0 || x >= ids.cols || y >= ids.rows) return {};
  const cv::Rect around = cv::Rect(x - 1, y - 1, 3, 3) & cv::Rect({}, ids.size());
  if (cv::countNonZero(ids(around) != ids.at<int>(y, x)) > 0) {
    if (RegionPoint fine = atFineScale(fraction); fine.region) return fine;
  }
  return full_.at(x, y);
}

RegionPoint ScenePointing::atFineScale(const QPointF& fraction) {
  const int x = static_cast<int>(fraction.x() * pixels_.width() * kPartsOfPixel);
  const int y = static_cast<int>(fraction.y() * pixels_.height() * kPartsOfPixel);
  scene_.drawIdsFinely(pixels_.width(), pixels_.height(), kPartsOfPixel,
                       {x - kFineRadius, y - kFineRadius, 2 * kFineRadius + 1, 2 * kFineRadius + 1},
                       fine_.ids);
  findRegions(fine_);
  return fine_.at(kFineRadius, kFineRadius);
}

RegionPoint ScenePointing::Picture::at(int x, int y) const {
  const int region = regions.at<int>(y, x);
  RegionPoint found{RegionId{static_cast<std::uint32_t>(region)}, {}};
  for (int reach = 0; region != 0 && reach <= kGapPasses; ++reach) {
    for (int v = std::max(0, y - reach); v <= std::min(regions.rows - 1, y + reach); ++v) {
      for (int u = std::max(0, x - reach); u <= std::min(regions.cols - 1, x + reach); ++u) {
        if (regions.at<int>(v, u) != region) continue;
        found.point_world = ids.pointAt(u, v);
        if (found.point_world) return found;
      }
    }
  }
  return found;
}

}  // namespace scantrove
