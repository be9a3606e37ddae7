#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace scantrove {

/// Histogram in CIE L*a*b*. Bins are wide, because light and shadow change colours. Each colour is shared
/// among the nearest bins.
class ColorHistogram {
 public:
  static constexpr std::size_t kBins = 5;  ///< of each of L*, a* and b*
  using Shares = std::array<float, kBins * kBins * kBins>;

  /// From the result of shares().
  [[nodiscard]] static ColorHistogram ofShares(const Shares& shares);
  void add(const Eigen::Vector3f& lab);
  void add(const ColorHistogram& other);
  [[nodiscard]] bool isEmpty() const { return colors_ == 0; }

  /// Histogram intersection (Swain and Ballard 1991), 0 .. 1; 0 if one is empty.
  [[nodiscard]] float intersection(const ColorHistogram& other) const;
  /// The share of each bin; the sum is 1, or 0 without colours.
  [[nodiscard]] Shares shares() const;

 private:
  Shares bins_{};
  float colors_ = 0;
};

}  // namespace scantrove
