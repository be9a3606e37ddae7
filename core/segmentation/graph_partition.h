#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace scantrove {

/// The partition of a weighted graph by Felzenszwalb and Huttenlocher (eq. 3.1 - 3.4): components joined in
/// increasing weight while `Dif(C1, C2) <= min(Int(C1) + k / |C1|, Int(C2) + k / |C2|)`. Since weights rise,
/// Int(C) is the weight of the last edge that joined C. Buffers are kept between graphs. One thread.
class GraphPartition {
 public:
  /// `node_count` components of one node each.
  void reset(std::size_t node_count, float k);

  /// Tries to join across an edge; edges must come in increasing weight. Returns false if the predicate
  /// rejects the edge; its ends are then in different components.
  bool join(std::uint32_t a, std::uint32_t b, float weight) {
    std::uint32_t root_a = find(a);
    std::uint32_t root_b = find(b);
    if (root_a == root_b) return true;
    if (weight > std::min(roots_[root_a].limit, roots_[root_b].limit)) return false;
    unite(root_a, root_b, weight);
    return true;
  }

  /// Joins across an edge if its ends lie in different components of which one has fewer than `min_size`
  /// nodes. Over the rejected edges in increasing weight, each small component goes to the neighbour with the
  /// smallest Dif.
  void absorb(std::uint32_t a, std::uint32_t b, float weight, std::uint32_t min_size) {
    const std::uint32_t root_a = find(a);
    const std::uint32_t root_b = find(b);
    if (root_a == root_b || std::min(roots_[root_a].size, roots_[root_b].size) >= min_size) return;
    unite(root_a, root_b, weight);
  }

  /// The component of a node, as the number of one of its nodes.
  [[nodiscard]] std::uint32_t find(std::uint32_t node) {
    for (std::uint32_t parent = parents_[node]; parent != node; parent = parents_[node]) {
      const std::uint32_t grandparent = parents_[parent];
      parents_[node] = grandparent;
      node = grandparent;
    }
    return node;
  }

 private:
  struct Root {
    std::uint32_t size;  ///< nodes of the component
    float limit;         ///< Int(C) + k / |C|
  };

  void unite(std::uint32_t root_a, std::uint32_t root_b, float weight) {
    if (roots_[root_a].size < roots_[root_b].size) std::swap(root_a, root_b);
    Root& winner = roots_[root_a];
    parents_[root_b] = root_a;
    winner.size += roots_[root_b].size;
    winner.limit = weight + k_ / static_cast<float>(winner.size);
  }

  // Separate arrays, so that the frequently read parents stay in the cache.
  std::vector<std::uint32_t> parents_;
  std::vector<Root> roots_;  ///< by node; outdated for nodes that are no longer roots
  float k_ = 0;
};

/// Sorts the edges 0 .. keys.size() - 1 by their 16-bit keys, ties by number, into `order`. Omits edges with
/// kEdgeNever. A counting sort: O(edges + keys). `counts` is working memory.
void sortEdges(std::span<const std::uint16_t> keys, std::vector<std::uint32_t>& counts,
               std::vector<std::uint32_t>& order);

}  // namespace scantrove
