#pragma once
#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "core/base/ids.h"
#include "core/labeling/fragment_colors.h"
#include "core/labeling/region_merger.h"

namespace scantrove {

/// How two fragments meet in one frame: along which pixels they touch in space, what the segments say there,
/// and how the fused surface bends across.
struct FragmentContact {
  FragmentId a, b;          ///< a < b
  int length_px = 0;        ///< steps from pixel to pixel across the border whose surfaces touch
  int bridged_px = 0;       ///< of these, with one segment on both sides
  float length_m = 0;       ///< of the border, as if seen face on
  float depth_m = 0;        ///< mean over the border
  int bends = 0;            ///< steps at which the bend could be measured
  float concavity_rad = 0;  ///< mean angle between the normals to both sides: > 0 a fold, < 0 a ridge
  /// Length of the mean difference in CIE L*a*b* between the colours to both sides; none without colour.
  std::optional<float> color_shift;
  float folded = 0;  ///< part of the measured steps that fold by more than kClearBend_rad
  float ridged = 0;  ///< and that ridge by more
  float step_m = 0;  ///< mean step up or down from one surface to the other; 0 where no normal is known
  std::optional<ColorComparison> colors;  ///< of the fragments on the whole, not at the border
};

/// Steps between the parts of an image that belong to different fragments: neighbours in the image whose
/// vertices are at most d_max of eq. 3.5 apart (a gap of up to two pixels without fragment is bridged).
/// Neighbours across an occlusion edge do not touch. `parts`: fragments, pixel by pixel. Ordered by (a, b).
[[nodiscard]] std::vector<FragmentContact> findContacts(const MergeInput& input,
                                                        std::span<const FragmentId> parts);

}  // namespace scantrove
