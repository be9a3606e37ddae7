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

/// Comparison of two fragments' colours in CIE L*a*b*. Parts of one object have similar colours, and shading
/// hardly changes chroma. Similarity means more for colours far from grey and rare elsewhere in the image.
/// The defaults mean neither similar nor different.
struct ColorComparison {
  float difference = 9;         ///< between their means
  float chroma_difference = 5;  ///< difference of a* and b* alone
  float shared = 0.5F;          ///< overlap of their chroma histograms: 0 .. 1
  float shared_chroma = 6;      ///< mean distance of the shared chromas from grey, times `shared`
  float elsewhere = 0.3F;       ///< part of the shared chromas that the rest of the image has too: 0 .. 1
  float variety = 6;            ///< standard deviation of the colours within the plainer fragment

  /// Adds an observation to a running mean, with weight `part`.
  void moveTowards(const ColorComparison& observed, float part);
};

/// The colours of each fragment's visible part in one frame.
class FragmentColors {
 public:
  /// One pass over the pixels. `parts`: fragments, pixel by pixel.
  FragmentColors(const MergeInput& input, std::span<const FragmentId> parts);

  /// Symmetric. None without colour, or if one of the two is not in view.
  [[nodiscard]] std::optional<ColorComparison> between(FragmentId a, FragmentId b) const;

 private:
  struct Colors {
    float pixels = 0;
    Eigen::Vector3f mean_lab = Eigen::Vector3f::Zero();
    float variety = 0;
    ChromaHistogram::Bins chromas = ChromaHistogram::Bins::Zero();  // pixels per bin
  };
  [[nodiscard]] const Colors* of(FragmentId fragment) const;

  std::unordered_map<FragmentId, std::size_t> places_;
  std::vector<Colors> colors_;  // in the order of their first pixels
  ChromaHistogram::Bins all_ = ChromaHistogram::Bins::Zero();
};

}  // namespace scantrove
