#include "core/discovery/silhouette.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/discovery/region_points.h"
#include "core/discovery/set_pixels.h"
#include "core/geometry/camera_depth.h"

namespace scantrove {
namespace {

constexpr int kFarBeyond_px = 4;  // labels and depth are uncertain nearer to an outline
// Lower steps are noise; higher ones only show how far the room extends behind an object.
constexpr float kMinRelief_m = 0.02F, kMaxRelief_m = 0.5F;

/// The number of pixels on the hull's edge and inside.
double pixelsOfHull(const std::vector<cv::Point>& points) {
  std::vector<cv::Point> hull;
  cv::convexHull(points, hull);
  if (hull.size() < 3) return static_cast<double>(points.size());
  return cv::contourArea(hull) + cv::arcLength(hull, true) / 2 + 1;
}

}  // namespace

Silhouette silhouetteOf(const RegionSet& regions, const cv::Rect& box_px, const DiscoveryInput& input) {
  const CameraDepth depth(input.view.T_world_camera);
  const SetPixels pixels(regions, box_px, input);
  std::vector<cv::Point> outline;
  std::size_t count = 0;
  float sum_m = 0;
  int steps = 0;
  pixels.forEach([&](int u, int v) {
    ++count;
    bool is_outline = false;
    for (const auto& [du, dv] : kFourNeighbors) {
      if (pixels.contains(u + du, v + dv)) continue;
      is_outline = true;
      const int beyond_u = u + kFarBeyond_px * du, beyond_v = v + kFarBeyond_px * dv;
      if (!pixels.isInside(beyond_u, beyond_v) || pixels.contains(beyond_u, beyond_v)) continue;
      const Eigen::Vector4f &here = input.view.vertices_world[pixels.at(u, v)],
                            &there = input.view.vertices_world[pixels.at(beyond_u, beyond_v)];
      if (!isSurface(here) || !isSurface(there)) continue;
      const float step_m = depth(there) - depth(here);
      if (!(step_m > kMinRelief_m)) continue;
      sum_m += std::min(step_m, kMaxRelief_m);
      ++steps;
    }
    if (is_outline) outline.emplace_back(u, v);
  });
  Silhouette silhouette;
  if (count == 0) return silhouette;
  silhouette.convexity = static_cast<float>(static_cast<double>(count) / pixelsOfHull(outline));
  if (steps > 0) silhouette.relief_m = sum_m / static_cast<float>(steps);
  return silhouette;
}

}  // namespace scantrove
