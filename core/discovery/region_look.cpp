#include "core/discovery/region_look.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/discovery/oriented_box.h"

namespace scantrove {
namespace {

constexpr float kThinnest_m = 0.02F;   ///< what a flat thing is taken for: its noise says nothing
constexpr float kColorUnknown = 0.5F;  ///< of what size says, where one has colour and the other none

/// Where a value lies between bins: the lower one, and the share of the upper one.
struct Between {
  std::size_t bin;
  float upper;
};

Between between(float value, float lowest, float highest) {
  const float last = static_cast<float>(RegionLook::kBins - 1);
  const float place = std::clamp((value - lowest) / (highest - lowest) * last, 0.0F, last - 1e-3F);
  const float floor = std::floor(place);
  return {static_cast<std::size_t>(floor), place - floor};
}

}  // namespace

RegionLook lookOf(std::span<const LookPoint> points) {
  RegionLook look;
  std::vector<Eigen::Vector4f> places;
  places.reserve(points.size());
  std::vector<cv::Vec3f> colors;
  for (const LookPoint& point : points) {
    places.push_back(point.position.homogeneous());
    if (point.has_color)
      colors.emplace_back(static_cast<float>(point.rgb[0]) / 255, static_cast<float>(point.rgb[1]) / 255,
                          static_cast<float>(point.rgb[2]) / 255);
  }
  look.size_m = fitOrientedBox(places).size_m;
  if (colors.empty()) return look;
  cv::Mat lab;
  cv::cvtColor(cv::Mat(1, static_cast<int>(colors.size()), CV_32FC3, colors.data()), lab, cv::COLOR_RGB2Lab);
  const float share = 1 / static_cast<float>(colors.size());
  for (const cv::Vec3f& color : cv::Mat_<cv::Vec3f>(lab)) {
    // Lightness is what light and shadow change: its bins are wide, and each colour counts in the two
    // nearest.
    const std::array<Between, 3> at{between(color[0], 0, 100), between(color[1], -50, 50),
                                    between(color[2], -50, 50)};
    for (unsigned corner = 0; corner < 8; ++corner) {
      float weight = share;
      std::size_t bin = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool is_upper = ((corner >> axis) & 1U) != 0;
        weight *= is_upper ? at[axis].upper : 1 - at[axis].upper;
        bin = bin * RegionLook::kBins + at[axis].bin + (is_upper ? 1 : 0);
      }
      look.colors[bin] += weight;
    }
  }
  return look;
}

float likeness(const RegionLook& a, const RegionLook& b) {
  float octaves = 0;
  for (int axis = 0; axis < 3; ++axis)
    octaves +=
        std::abs(std::log2(std::max(a.size_m[axis], kThinnest_m) / std::max(b.size_m[axis], kThinnest_m)));
  const float by_size = std::max(0.0F, 1 - octaves / 6);
  float shared = 0, sum_a = 0, sum_b = 0;
  for (std::size_t bin = 0; bin < a.colors.size(); ++bin) {
    shared += std::min(a.colors[bin], b.colors[bin]);
    sum_a += a.colors[bin];
    sum_b += b.colors[bin];
  }
  const bool has_a = sum_a > 0.5F, has_b = sum_b > 0.5F;
  if (has_a && has_b) return by_size * shared;
  return has_a == has_b ? by_size : kColorUnknown * by_size;
}

}  // namespace scantrove
