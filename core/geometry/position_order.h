#pragma once
#include <Eigen/Core>
#include <algorithm>

namespace scantrove {

/// Orders integer positions by x, then y, then z. Any thread.
struct PositionOrder {
  [[nodiscard]] bool operator()(const Eigen::Vector3i& a, const Eigen::Vector3i& b) const {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  }
};

}  // namespace scantrove
