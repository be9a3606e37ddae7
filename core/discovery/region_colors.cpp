#include "core/discovery/region_colors.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/base/check.h"
#include "core/discovery/camera_depth.h"
#include "core/discovery/region_points.h"

namespace scantrove {
namespace {

constexpr int kUsualWidth = 320, kUsualReach_px = 5;
constexpr int kLeastNear = 8;        // pixels of a neighbour within reach
constexpr float kTouches_m = 0.06F;  // nearer to the middle depth than that; grows with the distance
constexpr float kTouchGrowsFrom_m = 1.5F;

}  // namespace

RegionColors::RegionColors(const DiscoveryInput& input)
    : input_(input), reach_px_(std::max(1, kUsualReach_px * input.regions.width / kUsualWidth)) {
  if (input.color_lab.empty()) return;
  const std::vector<RegionId>& regions = input.regions.regions;
  SCANTROVE_CHECK(input.color_lab.size() == regions.size());
  RegionId last;
  ColorHistogram* of_last = nullptr;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (!regions[i]) continue;
    if (of_last == nullptr || regions[i] != last) of_last = &of_region_[regions[i]];
    last = regions[i];
    of_last->add(input.color_lab[i]);
  }
}

ColorHistogram RegionColors::colorsOf(const RegionSet& regions) const {
  ColorHistogram colors;
  for (const RegionId region : regions) {
    const auto found = of_region_.find(region);
    if (found != of_region_.end()) colors.add(found->second);
  }
  return colors;
}

cv::Mat RegionColors::ringAround(const RegionSet& regions, const cv::Rect& around_px) const {
  cv::Mat1b inside(around_px.size(), 0);
  for (int y = 0; y < inside.rows; ++y) {
    const RegionId* row = input_.regions.regions.data() +
                          static_cast<std::ptrdiff_t>(around_px.y + y) * input_.regions.width + around_px.x;
    for (int x = 0; x < inside.cols; ++x) inside(y, x) = regions.contains(row[x]) ? 255 : 0;
  }
  cv::Mat ring;
  cv::dilate(inside, ring, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}), {-1, -1}, reach_px_);
  ring -= inside;
  return ring;
}

std::optional<ColorLikeness> RegionColors::likenessOf(const RegionSet& regions,
                                                      const cv::Rect& box_px) const {
  if (input_.color_lab.empty()) return std::nullopt;
  const cv::Rect image_px(0, 0, input_.regions.width, input_.regions.height);
  const cv::Rect around_px =
      cv::Rect(box_px.tl() - cv::Point(reach_px_, reach_px_), box_px.br() + cv::Point(reach_px_, reach_px_)) &
      image_px;
  const cv::Mat1b ring = ringAround(regions, around_px);
  const auto forEachAround = [&](const auto& use) {
    for (int y = 0; y < ring.rows; ++y) {
      const cv::Point first = around_px.tl() + cv::Point(0, y);
      const auto row = static_cast<std::size_t>(first.y) * static_cast<std::size_t>(image_px.width) +
                       static_cast<std::size_t>(first.x);
      for (int x = 0; x < ring.cols; ++x) use(row + static_cast<std::size_t>(x), ring(y, x) != 0);
    }
  };

  const CameraDepth depth(input_.T_world_camera);
  double sum_m = 0;
  int points = 0;
  std::map<RegionId, int> near;
  forEachAround([&](std::size_t pixel, bool is_ring) {
    const RegionId region = input_.regions.regions[pixel];
    if (is_ring && region) ++near[region];
    if (is_ring || !regions.contains(region) || !isSurface(input_.vertices_world[pixel])) return;
    sum_m += static_cast<double>(depth(input_.vertices_world[pixel]));
    ++points;
  });
  const float middle_m = static_cast<float>(sum_m / std::max(points, 1));
  const float touches_m = kTouches_m * std::max(1.0F, middle_m / kTouchGrowsFrom_m);

  ColorHistogram touching;
  forEachAround([&](std::size_t pixel, bool is_ring) {
    if (!is_ring || !isSurface(input_.vertices_world[pixel])) return;
    if (std::abs(depth(input_.vertices_world[pixel]) - middle_m) < touches_m)
      touching.add(input_.color_lab[pixel]);
  });

  const ColorHistogram own = colorsOf(regions);
  ColorLikeness alike;
  alike.touching = own.intersection(touching);
  for (const auto& [region, pixels] : near) {
    if (pixels >= kLeastNear)
      alike.neighbour = std::max(alike.neighbour, own.intersection(colorsOf({region})));
  }
  return alike;
}

}  // namespace scantrove
