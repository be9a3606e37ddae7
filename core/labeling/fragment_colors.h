#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"
#include "core/labeling/chroma_histogram.h"
#include "core/labeling/region_merger.h"

namespace scantrove {

/// The colours of two fragments held against each other, in CIE L*a*b*. Two pieces of one thing have much the
/// same, and shading leaves chroma nearly as it is. That two are alike says the more, the further from grey
/// they are, and the less there is of the same elsewhere. As made: neither alike nor unlike.
struct ColorComparison {
  float difference = 9;         ///< between their means
  float chroma_difference = 5;  ///< of a* and b* alone
  float shared = 0.5F;          ///< part of their chromas that both have: 0 .. 1
  float shared_chroma = 6;      ///< of what both have, how far it is from grey, times that part
  float elsewhere = 0.3F;       ///< part of what both have that the rest of the picture has too: 0 .. 1
  float variety = 6;            ///< standard deviation of the colours within the plainer of the two

  /// A mean that another look is part of.
  void moveTowards(const ColorComparison& look, float part);
};

/// The colours of all that one frame shows of each fragment.
class FragmentColors {
 public:
  /// One pass over the pixels. `parts`: fragments, pixel by pixel.
  FragmentColors(const MergeInput& input, std::span<const FragmentId> parts);

  /// Which is which does not matter. None without colour, or where one of the two is not in view.
  [[nodiscard]] std::optional<ColorComparison> between(FragmentId a, FragmentId b) const;

 private:
  struct Colors {
    float pixels = 0;
    Eigen::Vector3f mean_lab = Eigen::Vector3f::Zero();
    float variety = 0;
    ChromaHistogram::Bins chromas = ChromaHistogram::Bins::Zero();  // pixels of each
  };
  [[nodiscard]] const Colors* of(FragmentId fragment) const;

  std::unordered_map<FragmentId, std::size_t> places_;
  std::vector<Colors> colors_;  // by place: in the order in which the pixels name them
  ChromaHistogram::Bins all_ = ChromaHistogram::Bins::Zero();
};

}  // namespace scantrove
