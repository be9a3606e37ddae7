#include "core/discovery/region_census.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"

namespace scantrove {
namespace {

/// Sums of u and u^2 for u in [0, n).
double sumBelow(double n) { return n * (n - 1) / 2; }
double sumSquaresBelow(double n) { return (n - 1) * n * (2 * n - 1) / 6; }

void addRun(RegionExtent& extent, int v, int begin, int end) {
  const double length = end - begin;
  const double sum_u = sumBelow(end) - sumBelow(begin);
  extent.pixels += end - begin;
  extent.sum_u += sum_u;
  extent.sum_v += length * v;
  extent.sum_uu += sumSquaresBelow(end) - sumSquaresBelow(begin);
  extent.sum_uv += sum_u * v;
  extent.sum_vv += length * v * v;
  extent.box_px |= cv::Rect(begin, v, end - begin, 1);
}

}  // namespace

double RegionExtent::orientation() const {
  const double n = static_cast<double>(pixels);
  const double u = centroidU(), v = centroidV();
  return std::atan2(2 * (sum_uv / n - u * v), sum_uu / n - u * u - (sum_vv / n - v * v)) / 2;
}

float RegionExtent::eccentricity() const {
  const double n = static_cast<double>(pixels);
  const double u = centroidU(), v = centroidV();
  // A pixel is a square of side 1, whose own second moment is 1/12.
  const double uu = sum_uu / n - u * u + 1.0 / 12, vv = sum_vv / n - v * v + 1.0 / 12,
               uv = sum_uv / n - u * v;
  const double mean = (uu + vv) / 2, spread = std::hypot((uu - vv) / 2, uv);
  const double smallest = std::max(mean - spread, 0.0);
  return static_cast<float>(std::sqrt(1 - smallest / (mean + spread)));
}

std::vector<RegionId> RegionCensus::regionsOfSize(double least_pixels) const {
  std::vector<RegionId> regions;
  for (const RegionExtent& extent : extents) {
    if (static_cast<double>(extent.pixels) >= least_pixels) regions.push_back(extent.region);
  }
  return regions;
}

RegionCensus RegionCounter::count(std::span<const RegionId> regions, int width) {
  SCANTROVE_CHECK(width > 0 && regions.size() % static_cast<std::size_t>(width) == 0);
  RegionCensus census;
  const auto height = static_cast<int>(regions.size() / static_cast<std::size_t>(width));
  for (int v = 0; v < height; ++v) {
    const RegionId* row = regions.data() + static_cast<std::ptrdiff_t>(v) * width;
    for (int begin = 0; begin < width;) {
      const RegionId region = row[begin];
      int end = begin + 1;
      while (end < width && row[end] == region) ++end;
      if (region) {
        if (region.value >= slot_of_region_.size()) {
          slot_of_region_.resize(region.value + region.value / 2 + 64, 0);
        }
        std::uint32_t& slot = slot_of_region_[region.value];
        if (slot == 0) {
          census.extents.emplace_back().region = region;
          slot = static_cast<std::uint32_t>(census.extents.size());
        }
        addRun(census.extents[slot - 1], v, begin, end);
      }
      begin = end;
    }
  }
  for (const RegionExtent& extent : census.extents) {
    slot_of_region_[extent.region.value] = 0;
    census.labeled_px |= extent.box_px;
  }
  std::ranges::sort(census.extents, {}, &RegionExtent::region);
  return census;
}

}  // namespace scantrove
