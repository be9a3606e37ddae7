#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/labeling/fragment_colors.h"
#include "core/labeling/region_merger.h"

namespace scantrove {

/// The contact of two fragments in one frame: the pixels where they touch in space, the segments there, and
/// the bend of the fused surface across it.
struct FragmentContact {
  FragmentId a, b;          ///< a < b
  int length_px = 0;        ///< steps between pixels across the border whose surfaces touch
  int bridged_px = 0;       ///< of these, with one segment on both sides
  float length_m = 0;       ///< of the border, corrected for the viewing angle
  float depth_m = 0;        ///< mean over the border
  int bends = 0;            ///< steps with a measured bend
  float concavity_rad = 0;  ///< mean angle between the normals to both sides: > 0 a fold, < 0 a ridge
  /// Length of the mean difference in CIE L*a*b* between the colours to both sides; none without colour.
  std::optional<float> color_shift;
  float folded = 0;  ///< part of the measured steps that fold by more than kClearBend_rad
  float ridged = 0;  ///< part of the measured steps that ridge by more
  float step_m = 0;  ///< mean height step between the surfaces; 0 without normals
  std::optional<ColorComparison> colors;  ///< of the whole fragments, not at the border
};

/// Contacts between the fragments of an image. Pixels touch if they are neighbours and their vertices are at
/// most d_max (eq. 3.5) apart. Gaps of up to two pixels without fragment are bridged; neighbours across an
/// occlusion edge do not touch. `parts`: the fragment of each pixel. Ordered by (a, b).
[[nodiscard]] std::vector<FragmentContact> findContacts(const MergeInput& input,
                                                        std::span<const FragmentId> parts);

}  // namespace scantrove
