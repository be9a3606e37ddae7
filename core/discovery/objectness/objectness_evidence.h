#pragma once
#include <Eigen/Core>
#include <optional>

#include "core/discovery/color_changes.h"
#include "core/discovery/outline_bounds.h"
#include "core/discovery/outward_odds.h"
#include "core/discovery/region_colors.h"

namespace scantrove {

/// What one view of some regions, and all that the map knows of them, says of whether they are one complete
/// object. objectness_features.h says what the model weighs of it.
struct ObjectnessEvidence {
  float pixels = 0;  ///< that show them, of an image of 320 x 240
  float shown = 1;   ///< the part of all that is known that is in view, hidden or not
  // Of their outline in the image, parts of what is known of it (OutlineSteps).
  float open = 0, folded = 0, ridged = 0, hidden = 0, cut = 0;
  float fill = 0;            ///< the part of their box in the image that they fill
  float convexity = 1;       ///< Silhouette
  float relief_m = 0;        ///< Silhouette
  float area_m2 = 0;         ///< visibleArea()
  float bulge = 0;           ///< bulgeOf() what is seen
  float known_bulge = 0;     ///< of all that is known
  float known_flatness = 0;  ///< OrientedBox::thickness_ratio of all that is known
  Eigen::Vector3f known_size_m = Eigen::Vector3f::Zero();  ///< longest first
  bool is_inconsistent = false;                            ///< RegionHypothesis::is_inconsistent
  float largest_part = 1;                                  ///< of the pixels, those of the region with most
  float odds = 0;                                          ///< RegionHypothesis::odds, of several regions
  float outward_odds = OutwardOdds::kMin;                  ///< OutwardOdds::most
  float joined_part = 0;                                   ///< OutwardOdds
  OutlineBounds bounds;
  // None: the image has no colour.
  std::optional<ColorLikeness> likeness;
  std::optional<ColorChanges> changes;

  /// Logarithm of the odds that they are one complete object and are seen as such (resources/models).
  [[nodiscard]] float logOdds() const;
};

}  // namespace scantrove
