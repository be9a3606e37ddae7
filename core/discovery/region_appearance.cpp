#include "core/discovery/region_appearance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/discovery/oriented_box.h"

namespace scantrove {
namespace {

constexpr float kThinnest_m = 0.02F;   ///< assumed for flat objects, whose measured thickness is noise
constexpr float kColorUnknown = 0.5F;  ///< factor on the size's likeness if only one has colour

}  // namespace

RegionAppearance appearanceOf(std::span<const AppearancePoint> points) {
  RegionAppearance appearance;
  std::vector<Eigen::Vector4f> places;
  places.reserve(points.size());
  std::vector<cv::Vec3f> colors;
  for (const AppearancePoint& point : points) {
    places.push_back(point.position.homogeneous());
    if (point.has_color)
      colors.emplace_back(static_cast<float>(point.rgb[0]) / 255, static_cast<float>(point.rgb[1]) / 255,
                          static_cast<float>(point.rgb[2]) / 255);
  }
  appearance.size_m = fitOrientedBox(places).size_m;
  if (colors.empty()) return appearance;
  cv::Mat lab;
  cv::cvtColor(cv::Mat(1, static_cast<int>(colors.size()), CV_32FC3, colors.data()), lab, cv::COLOR_RGB2Lab);
  for (const cv::Vec3f& color : cv::Mat_<cv::Vec3f>(lab))
    appearance.colors.add({color[0], color[1], color[2]});
  return appearance;
}

float likeness(const RegionAppearance& a, const RegionAppearance& b) {
  float octaves = 0;
  for (int axis = 0; axis < 3; ++axis)
    octaves +=
        std::abs(std::log2(std::max(a.size_m[axis], kThinnest_m) / std::max(b.size_m[axis], kThinnest_m)));
  const float by_size = std::max(0.0F, 1 - octaves / 6);
  const bool has_a = !a.colors.isEmpty(), has_b = !b.colors.isEmpty();
  if (has_a && has_b) return by_size * a.colors.intersection(b.colors);
  return has_a == has_b ? by_size : kColorUnknown * by_size;
}

}  // namespace scantrove
