#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <unordered_map>

#include "core/base/ids.h"
#include "core/labeling/region_merger.h"

namespace scantrove {

/// Between the mean colours of two fragments in CIE L*a*b*. Two pieces of one thing have much the same, and
/// shading leaves chroma nearly as it is.
struct ColorDifference {
  float all = 0;
  float chroma = 0;  ///< of a* and b* alone
};

/// The mean colours of all that one frame shows of each fragment.
class FragmentColors {
 public:
  /// One pass over the pixels. `parts`: fragments, pixel by pixel.
  FragmentColors(const MergeInput& input, std::span<const FragmentId> parts);

  /// Which is which does not matter. None without colour, or where one of the two is not in view.
  [[nodiscard]] std::optional<ColorDifference> between(FragmentId a, FragmentId b) const;

 private:
  std::unordered_map<FragmentId, Eigen::Vector3f> means_lab_;
};

}  // namespace scantrove
