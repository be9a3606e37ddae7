#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace scantrove {

/// Pairs (position in a, position in b) of two sorted lists of times, sorted by position. Assigns the closest
/// pairs first (ties: smallest positions), at most `tolerance_s` apart, each element to one pair at most.
/// Memory grows linearly with the lists, also with many equal times.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> associateTimes(const std::vector<double>& a,
                                                                              const std::vector<double>& b,
                                                                              double tolerance_s);

}  // namespace scantrove
