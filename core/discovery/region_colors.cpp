#include "core/discovery/region_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/base/check.h"
#include "core/discovery/region_points.h"
#include "core/discovery/set_pixels.h"
#include "core/geometry/camera_depth.h"
#include "core/geometry/surface_step.h"

namespace scantrove {
namespace {

constexpr int kUsualWidth = 320, kUsualReach_px = 5;  // past the blurred pixels of an edge
constexpr int kMinNear = 8;                           // pixels of a neighbour within reach
constexpr float kTouches_m = 0.06F;                   // from the mean depth; grows with the distance

}  // namespace

RegionColors::RegionColors(const DiscoveryInput& input)
    : input_(input), reach_px_(std::max(1, kUsualReach_px * input.view.K.width / kUsualWidth)) {
  if (input.color_lab.empty()) return;
  const std::span<const RegionId> regions = input.regions;
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

RegionColors::Surroundings RegionColors::around(const RegionSet& regions, const cv::Rect& box_px) const {
  const int width = input_.view.K.width;
  const cv::Point reach(reach_px_, reach_px_);
  const cv::Rect around_px =
      cv::Rect(box_px.tl() - reach, box_px.br() + reach) & cv::Rect(0, 0, width, input_.view.K.height);
  const auto pixelAt = [&](int x, int y) {
    return static_cast<std::size_t>(around_px.y + y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(around_px.x + x);
  };
  const CameraDepth depth(input_.view.T_world_camera);
  cv::Mat1b inside(around_px.size(), 0);
  double sum_m = 0;
  int points = 0;
  for (int y = 0; y < inside.rows; ++y) {
    for (int x = 0; x < inside.cols; ++x) {
      const std::size_t pixel = pixelAt(x, y);
      if (!regions.contains(input_.regions[pixel])) continue;
      inside(y, x) = 255;
      if (!isSurface(input_.view.vertices_world[pixel])) continue;
      sum_m += static_cast<double>(depth(input_.view.vertices_world[pixel]));
      ++points;
    }
  }
  const auto middle_m = static_cast<float>(sum_m / std::max(points, 1));
  const float touches_m = kTouches_m * std::max(1.0F, middle_m / kOcclusionStepGrowsFrom_m);

  cv::Mat1b reached;
  cv::dilate(inside, reached, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}), {-1, -1}, reach_px_);
  Surroundings surroundings;
  for (int y = 0; y < inside.rows; ++y) {
    for (int x = 0; x < inside.cols; ++x) {
      if (reached(y, x) == 0 || inside(y, x) != 0) continue;
      const std::size_t pixel = pixelAt(x, y);
      if (const RegionId region = input_.regions[pixel]) ++surroundings.pixels[region];
      const Eigen::Vector4f& vertex = input_.view.vertices_world[pixel];
      if (isSurface(vertex) && std::abs(depth(vertex) - middle_m) < touches_m)
        surroundings.touching.add(input_.color_lab[pixel]);
    }
  }
  return surroundings;
}

void RegionColors::compareHalves(const RegionSet& regions, const RegionExtent& extent,
                                 ColorLikeness& alike) const {
  const SetPixels pixels(regions, extent.box_px, input_);
  const SetAxes axes(pixels, extent);
  std::array<ColorHistogram, 2> along, across;
  pixels.forEach([&](int u, int v) {
    if ((u + v) % 2 != 0) return;  // every other pixel suffices
    const Eigen::Vector2f place = axes(u, v);
    const Eigen::Vector3f& lab = input_.color_lab[pixels.at(u, v)];
    along[place.x() > 0 ? 1 : 0].add(lab);
    across[place.y() > 0 ? 1 : 0].add(lab);
  });
  alike.end_to_end = along[0].intersection(along[1]);
  alike.side_to_side = across[0].intersection(across[1]);
}

std::optional<ColorLikeness> RegionColors::likenessOf(const RegionSet& regions,
                                                      const RegionExtent& extent) const {
  if (input_.color_lab.empty()) return std::nullopt;
  const Surroundings surroundings = around(regions, extent.box_px);
  const ColorHistogram own = colorsOf(regions);
  ColorLikeness alike;
  alike.touching = own.intersection(surroundings.touching);
  for (const auto& [region, pixels] : surroundings.pixels) {
    if (pixels >= kMinNear) alike.neighbor = std::max(alike.neighbor, own.intersection(colorsOf({region})));
  }
  compareHalves(regions, extent, alike);
  return alike;
}

}  // namespace scantrove
