#include "core/discovery/region_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/imgproc.hpp>

#include "core/geometry/camera_depth.h"

namespace scantrove {
namespace {

/// Relative depth difference across a pixel and its neighbours that makes a step. A surface seen at 83
/// degrees has as much.
constexpr float kStep = 0.06F;
/// A component with less than 1 / kPartOfLargest of the largest one's pixels is spill.
constexpr int kPartOfLargest = 10;
/// If less than 1 / kMinPart of the pixels remains, the object itself is thin, and nothing is removed.
constexpr int kMinPart = 2;

/// Keeps the larger components of `mask` and those not behind them. Parts at most 2 pixels wide, and depth
/// steps, do not connect.
cv::Mat bodyOf(const cv::Mat& mask, const cv::Mat1f& z_m) {
  cv::Mat nearest, farthest;
  cv::erode(z_m, nearest, {});
  cv::dilate(z_m, farthest, {});
  cv::Mat inside;
  cv::erode(mask, inside, {}, {-1, -1}, 1, cv::BORDER_CONSTANT, 0);
  inside &= farthest <= (1 + kStep) * nearest;
  cv::Mat piece_of, stats, middles;
  const int pieces = cv::connectedComponentsWithStats(inside, piece_of, stats, middles, 8, CV_32S);
  const auto areaOf = [&](int piece) { return stats.at<int>(piece, cv::CC_STAT_AREA); };
  int largest = 0;
  for (int piece = 1; piece < pieces; ++piece) largest = std::max(largest, areaOf(piece));
  for (int piece = 1; piece < pieces; ++piece) {
    if (kPartOfLargest * areaOf(piece) < largest) inside.setTo(0, piece_of == piece);
  }
  cv::Mat body;
  cv::dilate(inside, body, {});
  body &= mask;
  if (kMinPart * cv::countNonZero(body) < cv::countNonZero(mask)) return mask;
  // Spill lies behind the object; a handle does not.
  double farthest_of_body = 0;
  cv::minMaxLoc(z_m, nullptr, &farthest_of_body, nullptr, nullptr, body);
  return body | (mask & (z_m <= farthest_of_body));
}

/// Calls `use` with each pixel of the regions with a surface and its place in the box, in every `step`-th row
/// and column.
template <class Use>
void forEachPixel(const RegionSet& regions, const cv::Rect& box, const DiscoveryInput& input, Use&& use,
                  int step = 1) {
  for (int v = box.y; v < box.br().y; v += step) {
    for (int u = box.x; u < box.br().x; u += step) {
      const std::size_t pixel = input.view.K.indexOf(u, v);
      if (!regions.contains(input.regions[pixel])) continue;
      if (isSurface(input.view.vertices_world[pixel])) use(pixel, cv::Point(u, v) - box.tl());
    }
  }
}

}  // namespace

float visibleArea(const RegionExtent& extent, const DiscoveryInput& input) {
  const CameraDepth depth(input.view.T_world_camera);
  const int step = stepOfMeans(input.view.K.width);
  double sum = 0;
  const auto add = [&](std::size_t pixel, const cv::Point& /*place*/) {
    const float z = depth(input.view.vertices_world[pixel]);
    sum += static_cast<double>(z * z);
  };
  forEachPixel({extent.region}, extent.box_px, input, add, step);
  return static_cast<float>(sum * step * step /
                            (static_cast<double>(input.view.K.fx) * static_cast<double>(input.view.K.fy)));
}

float bulgeOf(const RegionSet& regions, const cv::Rect& box_px, const DiscoveryInput& input) {
  const int step = stepOfMeans(input.view.K.width);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  int points = 0;
  const auto add = [&](std::size_t pixel, const cv::Point& /*place*/) {
    sum += input.view.vertices_world[pixel].head<3>();
    ++points;
  };
  forEachPixel(regions, box_px, input, add, step);
  const Eigen::Vector3f middle = sum / static_cast<float>(std::max(points, 1));
  float outwards = 0, away = 0;
  const auto compare = [&](std::size_t pixel, const cv::Point& /*place*/) {
    if (!isSurface(input.view.normals_world[pixel])) return;
    const Eigen::Vector3f from_middle = input.view.vertices_world[pixel].head<3>() - middle;
    outwards += from_middle.dot(input.view.normals_world[pixel].head<3>());
    away += from_middle.norm();
  };
  forEachPixel(regions, box_px, input, compare, step);
  return away > 0 ? outwards / away : 0;
}

std::vector<Eigen::Vector4f> pointsOf(const RegionSet& regions, const cv::Rect& box_px,
                                      const DiscoveryInput& input) {
  const CameraDepth depth(input.view.T_world_camera);
  cv::Mat1f z_m(box_px.size(), 0.0F);
  cv::Mat1b mask(box_px.size(), 0);
  forEachPixel(regions, box_px, input, [&](std::size_t pixel, const cv::Point& place) {
    z_m(place) = depth(input.view.vertices_world[pixel]);
    mask(place) = 255;
  });
  const cv::Mat1b body = bodyOf(mask, z_m);
  std::vector<Eigen::Vector4f> points;
  forEachPixel(regions, box_px, input, [&](std::size_t pixel, const cv::Point& place) {
    if (body(place) != 0) points.push_back(input.view.vertices_world[pixel]);
  });
  return points;
}

}  // namespace scantrove
