#pragma once
#include <Eigen/Core>
#include <optional>

#include "core/discovery/color_changes.h"
#include "core/discovery/outline_bounds.h"
#include "core/discovery/outward_odds.h"
#include "core/discovery/region_colors.h"

namespace scantrove {

class ObjectnessModel;

/// Evidence whether some regions are one complete object, from one view and all known points of the map. See
/// objectness_features.h for the model's features, most of which are fields here: more than twenty.
struct ObjectnessEvidence {
  float pixels = 0;  ///< of the regions, in an image of 320 x 240
  float shown = 1;   ///< part of the known points in view, occluded or not
  // Parts of the known steps of their outline in the image (OutlineSteps).
  float open = 0, folded = 0, ridged = 0, hidden = 0, cut = 0;
  float fill = 0;            ///< their pixels / those of their box in the image
  float convexity = 1;       ///< Silhouette
  float relief_m = 0;        ///< Silhouette
  float area_m2 = 0;         ///< visibleArea()
  float bulge = 0;           ///< bulgeOf() in this view
  float known_bulge = 0;     ///< of all known points
  float known_flatness = 0;  ///< OrientedBox::thickness_ratio of all known points
  Eigen::Vector3f known_size_m = Eigen::Vector3f::Zero();  ///< longest first
  bool is_inconsistent = false;                            ///< RegionHypothesis::is_inconsistent
  float largest_part = 1;                                  ///< part of the pixels in the largest region
  float odds = 0;                                          ///< RegionHypothesis::odds, of several regions
  float outward_odds = OutwardOdds::kMin;                  ///< OutwardOdds::most
  float joined_part = 0;                                   ///< OutwardOdds
  float support = 0, carried = 0;                          ///< SupportShares, by pixels
  OutlineBounds bounds;
  // None without colour.
  std::optional<ColorLikeness> likeness;
  std::optional<ColorChanges> changes;

  /// Log-odds that they are one complete object and visible as such (resources/models). If the model does not
  /// read `support`, supportRule() limits them.
  [[nodiscard]] float logOdds() const;
  [[nodiscard]] float logOdds(const ObjectnessModel& model) const;
};

}  // namespace scantrove
