#pragma once
#include <map>
#include <optional>

#include "core/discovery/candidate_finder.h"
#include "core/discovery/color_histogram.h"
#include "core/discovery/region_census.h"
#include "core/discovery/region_set.h"

namespace scantrove {

/// How much two collections of colours are alike: 0 = nothing in common, 1 = the same.
struct ColorLikeness {
  /// With the neighbour in the image, of those that reach near it, that is most like it.
  float neighbor = 0;
  /// With what touches it: what lies around it and neither clearly before nor behind it.
  float touching = 0;
  // Of their two halves: on either side of the middle of their longer axis in the image, and of the other.
  // Things in a row are halved between them, or nearly so.
  float end_to_end = 0, side_to_side = 0;
};

/// The colours of the regions of an image. A piece of a thing is coloured like the rest of it, a whole thing
/// often unlike what it stands on.
class RegionColors {
 public:
  /// `input` must outlive this.
  explicit RegionColors(const DiscoveryInput& input);

  /// `extent` is that of all the regions together. Nothing where the image has no colour.
  [[nodiscard]] std::optional<ColorLikeness> likenessOf(const RegionSet& regions,
                                                        const RegionExtent& extent) const;

 private:
  /// What is near some regions in the image.
  struct Surroundings {
    std::map<RegionId, int> pixels;  // of each region
    ColorHistogram touching;         // of what is as far away as they are
  };
  [[nodiscard]] Surroundings around(const RegionSet& regions, const cv::Rect& box_px) const;
  [[nodiscard]] ColorHistogram colorsOf(const RegionSet& regions) const;
  void compareHalves(const RegionSet& regions, const RegionExtent& extent, ColorLikeness& alike) const;

  const DiscoveryInput& input_;
  std::map<RegionId, ColorHistogram> of_region_;
  int reach_px_;  // how far around regions others are near
};

}  // namespace scantrove
