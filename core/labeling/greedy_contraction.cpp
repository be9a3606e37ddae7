#include "core/labeling/greedy_contraction.h"

#include <map>
#include <numeric>
#include <queue>
#include <tuple>

namespace scantrove {
namespace {

struct Contraction {
  double weight;
  std::uint32_t a, b;  // a < b
  bool operator<(const Contraction& other) const {
    return std::tie(weight, other.a, other.b) < std::tie(other.weight, a, b);
  }
};

class Contractor {
 public:
  Contractor(std::size_t node_count, std::span<const WeightedEdge> edges)
      : parent_(node_count), sums_(node_count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    for (const WeightedEdge& edge : edges) {
      if (edge.a == edge.b) continue;
      sums_[edge.a][edge.b] += static_cast<double>(edge.weight);
      sums_[edge.b][edge.a] += static_cast<double>(edge.weight);
    }
    for (std::uint32_t a = 0; a < node_count; ++a) {
      for (const auto& [b, sum] : sums_[a]) {
        if (a < b) offer(a, b, sum);
      }
    }
  }

  void run() {
    while (!queue_.empty()) {
      const Contraction best = queue_.top();
      queue_.pop();
      const auto sum = sums_[best.a].find(best.b);  // removed or changed: a newer entry exists
      if (sum == sums_[best.a].end() || sum->second != best.weight) continue;
      contract(best.a, best.b);
    }
  }

  [[nodiscard]] std::uint32_t find(std::uint32_t node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }

 private:
  void offer(std::uint32_t a, std::uint32_t b, double sum) {
    if (sum > 0) queue_.push({sum, std::min(a, b), std::max(a, b)});
  }

  void contract(std::uint32_t into, std::uint32_t from) {
    parent_[from] = into;
    sums_[into].erase(from);
    sums_[from].erase(into);
    for (const auto& [other, sum] : sums_[from]) {
      double& joint = sums_[into][other];
      joint += sum;
      sums_[other].erase(from);
      sums_[other][into] = joint;
      offer(into, other, joint);
    }
    sums_[from].clear();
  }

  std::vector<std::uint32_t> parent_;
  std::vector<std::map<std::uint32_t, double>> sums_;  // between parts that have an edge
  std::priority_queue<Contraction> queue_;
};

}  // namespace

std::vector<std::uint32_t> contractGreedily(std::size_t node_count, std::span<const WeightedEdge> edges) {
  Contractor contractor(node_count, edges);
  contractor.run();
  std::vector<std::uint32_t> number(node_count, static_cast<std::uint32_t>(node_count));
  std::vector<std::uint32_t> part(node_count);
  std::uint32_t count = 0;
  for (std::uint32_t node = 0; node < node_count; ++node) {
    std::uint32_t& of_root = number[contractor.find(node)];
    if (of_root == node_count) of_root = count++;
    part[node] = of_root;
  }
  return part;
}

}  // namespace scantrove
