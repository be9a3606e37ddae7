#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace scantrove {

/// Pairs (position in a, position in b) of two sorted lists of times: the closest pairs first (of equally
/// close ones that of the smallest positions), none further apart than `tolerance_s`, each element in one
/// pair at most; sorted by position. Memory grows linearly with the lists, however many times are equal.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> associateTimes(const std::vector<double>& a,
                                                                              const std::vector<double>& b,
                                                                              double tolerance_s);

}  // namespace scantrove
