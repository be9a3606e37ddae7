#pragma once
#include <Eigen/Core>

namespace scantrove {

/// Histogram of a* and b* of CIE L*a*b*, independent of brightness. Each colour is shared among its four
/// nearest bins; colours outside the range count in the outermost bins.
class ChromaHistogram {
 public:
  static constexpr int kSide = 16;       ///< bins of a*, and of b*
  static constexpr float kBinWidth = 8;  ///< from centre to centre; grey is in the middle
  using Bins = Eigen::Array<float, kSide * kSide, 1>;

  void add(const Eigen::Vector3f& lab);

  [[nodiscard]] const Bins& counts() const { return counts_; }
  /// Distance of each bin's centre from grey.
  [[nodiscard]] static const Bins& chromas();

 private:
  Bins counts_ = Bins::Zero();
};

}  // namespace scantrove
