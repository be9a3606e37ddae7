#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace scantrove {

/// A balanced decision tree of so many levels, one of many whose values add up.
template <std::size_t Levels>
struct BoostedTree {
  struct Split {
    std::int8_t feature;
    float most;  ///< up to this the way goes to the left
  };
  static constexpr std::size_t kLeaves = std::size_t{1} << Levels, kSplits = kLeaves - 1;

  std::array<Split, kSplits> splits;  ///< the root, its two children, their four, and so on
  std::array<float, kLeaves> leaves;  ///< from left to right

  [[nodiscard]] float valueOf(std::span<const float> features) const {
    std::size_t node = 0;
    while (node < kSplits) {
      const Split& split = splits[node];
      node = 2 * node + (features[static_cast<std::size_t>(split.feature)] <= split.most ? 1 : 2);
    }
    return leaves[node - kSplits];
  }
};

}  // namespace scantrove
