#include "core/discovery/silhouette.h"

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/discovery/camera_depth.h"
#include "core/discovery/region_points.h"

namespace scantrove {
namespace {

constexpr int kFarBeyond_px = 4;  // labels and depth are unsure nearer to an outline
constexpr float kLeastRelief_m = 0.02F, kMostRelief_m = 0.5F;

/// Of all pixels on the hull's edge and inside.
double pixelsOfHull(const std::vector<cv::Point>& points) {
  std::vector<cv::Point> hull;
  cv::convexHull(points, hull);
  if (hull.size() < 3) return static_cast<double>(points.size());
  return cv::contourArea(hull) + cv::arcLength(hull, true) / 2 + 1;
}

}  // namespace

Silhouette silhouetteOf(const RegionSet& regions, const cv::Rect& box_px, const DiscoveryInput& input) {
  constexpr std::array<std::array<int, 2>, 4> kWays{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  const cv::Rect image(0, 0, input.regions.width, input.regions.height);
  const CameraDepth depth(input.T_world_camera);
  const auto at = [&image](const cv::Point& pixel) {
    return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(image.width) +
           static_cast<std::size_t>(pixel.x);
  };
  const auto isIn = [&](const cv::Point& pixel) {
    const RegionId region = input.regions.regions[at(pixel)];
    return region && regions.contains(region);
  };
  std::vector<cv::Point> outline;
  std::size_t pixels = 0;
  float sum_m = 0;
  int steps = 0;
  for (int y = box_px.y; y < box_px.br().y; ++y) {
    for (int x = box_px.x; x < box_px.br().x; ++x) {
      const cv::Point pixel(x, y);
      if (!isIn(pixel)) continue;
      ++pixels;
      bool is_outline = false;
      for (const auto& [du, dv] : kWays) {
        const cv::Point next(x + du, y + dv), beyond(x + kFarBeyond_px * du, y + kFarBeyond_px * dv);
        if (image.contains(next) && isIn(next)) continue;
        is_outline = true;
        if (!image.contains(beyond) || isIn(beyond)) continue;
        const Eigen::Vector4f &here = input.vertices_world[at(pixel)],
                              &there = input.vertices_world[at(beyond)];
        if (!isSurface(here) || !isSurface(there)) continue;
        const float step_m = depth(there) - depth(here);
        if (!(step_m > kLeastRelief_m)) continue;
        sum_m += std::min(step_m, kMostRelief_m);
        ++steps;
      }
      if (is_outline) outline.push_back(pixel);
    }
  }
  Silhouette silhouette;
  if (pixels == 0) return silhouette;
  silhouette.convexity = static_cast<float>(static_cast<double>(pixels) / pixelsOfHull(outline));
  if (steps > 0) silhouette.relief_m = sum_m / static_cast<float>(steps);
  return silhouette;
}

}  // namespace scantrove
