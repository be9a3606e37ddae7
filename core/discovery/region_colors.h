#pragma once
#include <map>
#include <optional>

#include "core/discovery/candidate_finder.h"
#include "core/discovery/color_histogram.h"
#include "core/discovery/region_census.h"
#include "core/discovery/region_set.h"

namespace scantrove {

/// Colour similarities of some regions: 0 = nothing in common, 1 = equal.
struct ColorLikeness {
  /// To the most similar of the regions near it in the image.
  float neighbor = 0;
  /// To the pixels around it at a similar depth.
  float touching = 0;
  // Between their two halves, divided at the middle of the longer axis in the image, and of the shorter axis.
  // The division of objects in a row lies at or near the gap between them.
  float end_to_end = 0, side_to_side = 0;
};

/// The colours of the regions of an image. A part of an object resembles the rest in colour; a complete
/// object often differs from its support.
class RegionColors {
 public:
  /// `input` must outlive this.
  explicit RegionColors(const DiscoveryInput& input);

  /// `extent`: of all the regions together. None without colour.
  [[nodiscard]] std::optional<ColorLikeness> likenessOf(const RegionSet& regions,
                                                        const RegionExtent& extent) const;

 private:
  /// The pixels near some regions in the image.
  struct Surroundings {
    std::map<RegionId, int> pixels;  // of each region
    ColorHistogram touching;         // of pixels at a similar depth
  };
  [[nodiscard]] Surroundings around(const RegionSet& regions, const cv::Rect& box_px) const;
  [[nodiscard]] ColorHistogram colorsOf(const RegionSet& regions) const;
  void compareHalves(const RegionSet& regions, const RegionExtent& extent, ColorLikeness& alike) const;

  const DiscoveryInput& input_;
  std::map<RegionId, ColorHistogram> of_region_;
  int reach_px_;  // distance up to which others are near
};

}  // namespace scantrove
