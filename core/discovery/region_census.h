#pragma once
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <span>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// Pixel statistics of one region, over all its parts in the image.
struct RegionExtent {
  RegionId region;
  std::int64_t pixels = 0;
  cv::Rect box_px;
  double sum_u = 0, sum_v = 0, sum_uu = 0, sum_uv = 0, sum_vv = 0;  ///< over its pixels, image moments

  /// Adds the pixels of another region.
  void add(const RegionExtent& other) {
    pixels += other.pixels;
    box_px |= other.box_px;
    sum_u += other.sum_u;
    sum_v += other.sum_v;
    sum_uu += other.sum_uu;
    sum_uv += other.sum_uv;
    sum_vv += other.sum_vv;
  }
  [[nodiscard]] double centroidU() const { return sum_u / static_cast<double>(pixels); }
  [[nodiscard]] double centroidV() const { return sum_v / static_cast<double>(pixels); }
  /// Direction of the longer axis of the ellipse with the same second moments, from u towards v, radians.
  [[nodiscard]] double orientation() const;
  /// Eccentricity of that ellipse: 0 = round, towards 1 = a line.
  [[nodiscard]] float eccentricity() const;
};

/// All regions of the image.
struct RegionCensus {
  std::vector<RegionExtent> extents;  ///< by region id
  cv::Rect labeled_px;                ///< box around all labelled pixels

  /// Regions with at least `least_pixels` pixels, in order.
  [[nodiscard]] std::vector<RegionId> regionsOfSize(double least_pixels) const;
};

/// Counts regions run by run in one pass over the labels. Keeps its tables between frames.
class RegionCounter {
 public:
  /// `regions`: an image of width `width`, row by row.
  [[nodiscard]] RegionCensus count(std::span<const RegionId> regions, int width);

 private:
  std::vector<std::uint32_t> slot_of_region_;  // 1 + index in extents; 0 = not in this frame
};

}  // namespace scantrove
