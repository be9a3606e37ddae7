#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace scantrove {

/// How often colours occur, in CIE L*a*b*. Bins are wide, for light and shadow change colours, and each
/// colour counts in those nearest.
class ColorHistogram {
 public:
  static constexpr std::size_t kBins = 5;  ///< of each of L*, a* and b*
  using Shares = std::array<float, kBins * kBins * kBins>;

  /// As shares() gave them.
  [[nodiscard]] static ColorHistogram ofShares(const Shares& shares);
  void add(const Eigen::Vector3f& lab);
  void add(const ColorHistogram& other);
  [[nodiscard]] bool isEmpty() const { return colors_ == 0; }

  /// The part of their colours that two have in common (Swain and Ballard 1991): 0 .. 1. 0 where one is
  /// empty.
  [[nodiscard]] float intersection(const ColorHistogram& other) const;
  /// Of each bin; their sum is 1, or 0 where there are no colours.
  [[nodiscard]] Shares shares() const;

 private:
  Shares bins_{};
  float colors_ = 0;
};

}  // namespace scantrove
