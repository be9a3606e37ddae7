#include "ui/view/scene_pointing.h"

#include <algorithm>

namespace scantrove {
namespace {

constexpr double kIdsPerPixel = 0.5;  ///< resolution of pointing
constexpr int kGapPasses = 2;

/// Between two points of a coarse cloud nothing is drawn: a pixel there belongs to the surface around it.
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
  is_old_ = true;
}

const cv::Mat& ScenePointing::regionIds() {
  if (!is_old_) return region_ids_;
  is_old_ = false;
  scene_.drawIds(pixels_.width(), pixels_.height(), static_cast<float>(kIdsPerPixel / ratio_), ids_);
  region_ids_.create(ids_.height(), ids_.width(), CV_32SC1);
  std::transform(
      ids_.fragments().begin(), ids_.fragments().end(), region_ids_.begin<int>(),
      [this](FragmentId fragment) { return static_cast<int>(scene_.cloud().regionOf(fragment).value); });
  for (int pass = 0; pass < kGapPasses; ++pass) closeGaps(region_ids_);
  return region_ids_;
}

RegionPoint ScenePointing::at(const QPointF& fraction) {
  const cv::Mat& ids = regionIds();
  if (ids.empty()) return {};
  const int x = static_cast<int>(fraction.x() * ids.cols);
  const int y = static_cast<int>(fraction.y() * ids.rows);
  if (fraction.x() < 0 || fraction.y() < 0 || x >= ids.cols || y >= ids.rows) return {};
  return {RegionId{static_cast<std::uint32_t>(ids.at<int>(y, x))}, surfaceNear(x, y)};
}

std::optional<Eigen::Vector3f> ScenePointing::surfaceNear(int x, int y) const {
  const int region = region_ids_.at<int>(y, x);
  for (int reach = 0; region != 0 && reach <= kGapPasses; ++reach) {
    for (int v = std::max(0, y - reach); v <= std::min(region_ids_.rows - 1, y + reach); ++v) {
      for (int u = std::max(0, x - reach); u <= std::min(region_ids_.cols - 1, x + reach); ++u) {
        if (region_ids_.at<int>(v, u) != region) continue;
        if (auto point = ids_.pointAt(u, v)) return point;
      }
    }
  }
  return std::nullopt;
}

}  // namespace scantrove
