#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace scantrove::reference {

struct GraphEdge {
  std::uint32_t a, b;
  float weight;
};

/// The literal algorithm of Felzenszwalb and Huttenlocher: each node stores the number of its component, and
/// Int(C) is recomputed each time as the largest weight of a minimum spanning tree of C (Prim).
class LiteralPartition {
 public:
  LiteralPartition(std::size_t node_count, std::vector<GraphEdge> edges, float k)
      : component_(node_count), edges_(std::move(edges)), k_(k) {
    std::iota(component_.begin(), component_.end(), 0U);
    std::vector<std::size_t> order(edges_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t x, std::size_t y) { return edges_[x].weight < edges_[y].weight; });
    for (const std::size_t e : order) {
      const std::uint32_t a = component_[edges_[e].a];
      const std::uint32_t b = component_[edges_[e].b];
      if (a != b && edges_[e].weight <= minimumInternal(a, b)) {
        std::replace(component_.begin(), component_.end(), b, a);
      }
    }
  }

  [[nodiscard]] const std::vector<std::uint32_t>& components() const { return component_; }

  /// MInt(C1, C2), eq. 3.4.
  [[nodiscard]] float minimumInternal(std::uint32_t a, std::uint32_t b) const {
    return std::min(limit(a), limit(b));
  }

  /// Dif(C1, C2), eq. 3.2: the smallest weight between them, infinity if there is none.
  [[nodiscard]] float difference(std::uint32_t a, std::uint32_t b) const {
    float smallest = std::numeric_limits<float>::infinity();
    for (const GraphEdge& edge : edges_) {
      const std::uint32_t x = component_[edge.a], y = component_[edge.b];
      if ((x == a && y == b) || (x == b && y == a)) smallest = std::min(smallest, edge.weight);
    }
    return smallest;
  }

 private:
  float limit(std::uint32_t c) const {
    const auto size = std::count(component_.begin(), component_.end(), c);
    return internal(c) + k_ / static_cast<float>(size);
  }

  float internal(std::uint32_t c) const {
    std::vector<bool> reached(component_.size(), false);
    const auto first = std::find(component_.begin(), component_.end(), c) - component_.begin();
    reached[static_cast<std::size_t>(first)] = true;
    float largest = 0;
    while (true) {
      const GraphEdge* next = nullptr;
      for (const GraphEdge& edge : edges_) {
        if (component_[edge.a] != c || component_[edge.b] != c || reached[edge.a] == reached[edge.b])
          continue;
        if (next == nullptr || edge.weight < next->weight) next = &edge;
      }
      if (next == nullptr) return largest;
      reached[next->a] = reached[next->b] = true;
      largest = std::max(largest, next->weight);
    }
  }

  std::vector<std::uint32_t> component_;
  std::vector<GraphEdge> edges_;
  float k_;
};

/// Renumbers components 1, 2, ... by their first node, so that equal partitions are equal vectors.
inline std::vector<std::uint32_t> canonical(const std::vector<std::uint32_t>& components) {
  std::vector<std::uint32_t> number(
      components.empty() ? 0 : *std::max_element(components.begin(), components.end()) + 1, 0);
  std::vector<std::uint32_t> result;
  std::uint32_t next = 0;
  for (const std::uint32_t c : components) {
    if (number[c] == 0) number[c] = ++next;
    result.push_back(number[c]);
  }
  return result;
}

}  // namespace scantrove::reference
