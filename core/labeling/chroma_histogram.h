#pragma once
#include <Eigen/Core>

namespace scantrove {

/// How often colours occur whatever their brightness: a* and b* of CIE L*a*b*. Each colour counts in the four
/// bins nearest; what is beyond the last bins counts in those.
class ChromaHistogram {
 public:
  static constexpr int kSide = 16;       ///< bins of a*, and of b*
  static constexpr float kBinWidth = 8;  ///< from centre to centre; grey is in the middle
  using Bins = Eigen::Array<float, kSide * kSide, 1>;

  void add(const Eigen::Vector3f& lab);

  [[nodiscard]] const Bins& counts() const { return counts_; }
  /// How far the centre of each bin is from grey.
  [[nodiscard]] static const Bins& chromas();

 private:
  Bins counts_ = Bins::Zero();
};

}  // namespace scantrove
