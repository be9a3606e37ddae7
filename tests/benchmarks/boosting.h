#pragma once
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/boosted_tree.h"

namespace scantrove::benchmarks {

/// Something that is so, or is not.
struct BoostingSample {
  std::span<const float> x;  ///< features, as many in each
  bool is_so = false;
  float weight = 1;
};

struct BoostingParams {
  std::size_t trees = 100;
  double learning_rate = 0.1;
  double ridge = 5;             ///< on each leaf
  int least_samples = 100;      ///< of a leaf
  double part_of_features = 1;  ///< that a tree may ask for, by chance: the trees differ more
  /// By feature: 1 where more of it must never make less likely, -1 never more, 0 whatever the samples say.
  /// Empty: 0 for all.
  std::vector<int> directions = {};
};

/// Trees whose values, and the prior, add up to the logarithm of the odds that something is so.
template <std::size_t Levels>
struct BoostedTrees {
  float prior = 0;
  std::vector<BoostedTree<Levels>> trees;

  [[nodiscard]] float oddsOf(std::span<const float> x) const {
    return std::accumulate(trees.begin(), trees.end(), prior,
                           [&](float sum, const BoostedTree<Levels>& tree) { return sum + tree.valueOf(x); });
  }
};

/// Samples by feature and bin, so that splits are found by sums over bins.
class BoostingBins {
 public:
  explicit BoostingBins(std::span<const BoostingSample> samples)
      : limits_(samples.front().x.size()), bins_(limits_.size()) {
    for (std::size_t f = 0; f < limits_.size(); ++f) {
      std::vector<float> values;
      for (const BoostingSample& sample : samples) values.push_back(sample.x[f]);
      std::ranges::sort(values);
      for (std::size_t b = 1; b < kBins; ++b) {
        const std::size_t at = b * values.size() / kBins;
        const float limit = (values[at - 1] + values[at]) / 2;
        if (limit < values.back() && (limits_[f].empty() || limit > limits_[f].back()))
          limits_[f].push_back(limit);
      }
      for (const BoostingSample& sample : samples) bins_[f].push_back(binOf(f, sample.x[f]));
    }
  }
  [[nodiscard]] std::size_t features() const { return limits_.size(); }
  [[nodiscard]] std::size_t of(std::size_t feature, std::size_t sample) const {
    return bins_[feature][sample];
  }
  /// The highest value of each bin but the last.
  [[nodiscard]] const std::vector<float>& limits(std::size_t feature) const { return limits_[feature]; }

 private:
  static constexpr std::size_t kBins = 64;  // of a feature's values, as many in each

  [[nodiscard]] std::uint8_t binOf(std::size_t feature, float value) const {
    return static_cast<std::uint8_t>(std::ranges::lower_bound(limits_[feature], value) -
                                     limits_[feature].begin());
  }
  std::vector<std::vector<float>> limits_;
  std::vector<std::vector<std::uint8_t>> bins_;
};

/// Fits trees to samples: logistic loss, Newton's step in each leaf (Friedman 2001; Chen and Guestrin 2016).
/// The same samples give the same trees.
template <std::size_t Levels>
class Boosting {
 public:
  Boosting(std::span<const BoostingSample> samples, const BoostingParams& params)
      : params_(params), samples_(samples), bins_(samples), odds_(samples.size()) {
    double all = 0, so = 0;
    for (const BoostingSample& sample : samples) {
      all += static_cast<double>(sample.weight);
      so += sample.is_so ? static_cast<double>(sample.weight) : 0;
    }
    fitted_.prior = static_cast<float>(std::log(so / (all - so)));
    std::ranges::fill(odds_, fitted_.prior);
    for (std::size_t i = 0; i < params_.trees; ++i) addTree();
  }
  [[nodiscard]] BoostedTrees<Levels> fitted() && { return std::move(fitted_); }

 private:
  using Tree = BoostedTree<Levels>;
  /// Sums of the loss' first and second derivatives.
  struct Slope {
    double first = 0, second = 0;
    int count = 0;
    void operator+=(const Slope& other) {
      first += other.first;
      second += other.second;
      count += other.count;
    }
    [[nodiscard]] Slope without(const Slope& other) const {
      return {first - other.first, second - other.second, count - other.count};
    }
  };

  /// What leaves may say.
  struct Range {
    float least = -std::numeric_limits<float>::max(), most = std::numeric_limits<float>::max();
  };
  struct Split {
    typename Tree::Split split;
    Range left, right;
  };

  [[nodiscard]] double gainOf(const Slope& slope) const {
    return slope.first * slope.first / (slope.second + params_.ridge);
  }
  [[nodiscard]] float valueIn(const Range& range, const Slope& slope) const {
    return std::clamp(
        static_cast<float>(-params_.learning_rate * slope.first / (slope.second + params_.ridge)),
        range.least, range.most);
  }
  [[nodiscard]] Slope slopeAt(std::size_t i) const {
    const double p = 1 / (1 + std::exp(-static_cast<double>(odds_[i])));
    const auto weight = static_cast<double>(samples_[i].weight);
    return {weight * (p - (samples_[i].is_so ? 1 : 0)), weight * p * (1 - p), 1};
  }
  void addTree() {
    std::vector<Slope> slopes;
    for (std::size_t i = 0; i < samples_.size(); ++i) slopes.push_back(slopeAt(i));
    const std::vector<std::size_t> features = drawFeatures();
    Tree tree{};
    std::vector<std::vector<std::size_t>> nodes(Tree::kSplits + Tree::kLeaves);
    std::vector<Range> ranges(nodes.size());
    nodes[0].resize(samples_.size());
    std::iota(nodes[0].begin(), nodes[0].end(), std::size_t{0});
    for (std::size_t node = 0; node < Tree::kSplits; ++node) {
      const Split best = bestSplit(nodes[node], slopes, features, ranges[node]);
      tree.splits[node] = best.split;
      ranges[2 * node + 1] = best.left;
      ranges[2 * node + 2] = best.right;
      const auto [feature, most] = best.split;
      for (const std::size_t i : nodes[node]) {
        const bool is_left = samples_[i].x[static_cast<std::size_t>(feature)] <= most;
        nodes[2 * node + (is_left ? 1 : 2)].push_back(i);
      }
    }
    for (std::size_t leaf = 0; leaf < Tree::kLeaves; ++leaf) {
      Slope all;
      for (const std::size_t i : nodes[Tree::kSplits + leaf]) all += slopes[i];
      tree.leaves[leaf] = valueIn(ranges[Tree::kSplits + leaf], all);
    }
    for (std::size_t i = 0; i < samples_.size(); ++i) odds_[i] += tree.valueOf(samples_[i].x);
    fitted_.trees.push_back(tree);
  }
  [[nodiscard]] std::vector<std::size_t> drawFeatures() {
    std::vector<std::size_t> features(bins_.features());
    std::iota(features.begin(), features.end(), std::size_t{0});
    const auto drawn =
        static_cast<std::size_t>(params_.part_of_features * static_cast<double>(features.size()));
    for (std::size_t i = 0; i < drawn; ++i)
      std::swap(features[i], features[i + random_() % (features.size() - i)]);
    features.resize(drawn);
    return features;
  }
  /// Where nothing is gained all go to the left. `range`: of the values below the node.
  [[nodiscard]] Split bestSplit(const std::vector<std::size_t>& node, const std::vector<Slope>& slopes,
                                const std::vector<std::size_t>& features, const Range& range) const {
    Split best{{0, std::numeric_limits<float>::max()}, range, range};
    double most = 0;
    for (const std::size_t feature : features) {
      const std::vector<float>& limits = bins_.limits(feature);
      std::vector<Slope> sums(limits.size() + 1);
      Slope all;
      for (const std::size_t i : node) {
        sums[bins_.of(feature, i)] += slopes[i];
        all += slopes[i];
      }
      Slope left;
      for (std::size_t bin = 0; bin < limits.size(); ++bin) {
        left += sums[bin];
        const Slope right = all.without(left);
        if (left.count < params_.least_samples || right.count < params_.least_samples) continue;
        const double gain = gainOf(left) + gainOf(right) - gainOf(all);
        if (gain <= most) continue;
        const int direction = params_.directions.empty() ? 0 : params_.directions[feature];
        const float less = valueIn(range, left), more = valueIn(range, right);
        if (static_cast<float>(direction) * (more - less) < 0) continue;
        most = gain;
        best = {{static_cast<std::int8_t>(feature), limits[bin]}, range, range};
        // Whatever comes further below, one side stays above the other.
        if (direction != 0) {
          (direction > 0 ? best.left.most : best.left.least) = (less + more) / 2;
          (direction > 0 ? best.right.least : best.right.most) = (less + more) / 2;
        }
      }
    }
    return best;
  }

  BoostingParams params_;
  std::span<const BoostingSample> samples_;
  BoostingBins bins_;
  std::vector<float> odds_;
  BoostedTrees<Levels> fitted_;
  std::mt19937 random_;  // as it starts by default: the same trees each time
};

inline std::string inCpp(float value) {
  std::string text = fmt::format("{:.4g}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text + "F";
}

/// Of odds and what is so: part of the pairs of one that is so and one that is not that are in the right
/// order.
inline double areaUnderCurve(std::vector<std::pair<float, bool>> judged) {
  std::ranges::sort(judged);
  double below = 0, ordered = 0;
  for (const auto& [odds, is_so] : judged) (is_so ? ordered : below) += is_so ? below : 1;
  return ordered / (below * (static_cast<double>(judged.size()) - below));
}

/// A header with k<name>Prior and k<name>Trees. `by`: what fitted them, to what; `more`: lines between.
template <std::size_t Levels>
void printTrees(const BoostedTrees<Levels>& fitted, const std::string& name, const std::string& by,
                const std::string& more = {}) {
  std::printf(
      "#pragma once\n#include <array>\n\n#include \"core/base/boosted_tree.h\"\n\n"
      "namespace scantrove {\n\n// clang-format off\n// By %s.\n"
      "inline constexpr float k%sPrior = %s;\n%sinline constexpr std::array<BoostedTree<%zu>, %zu> "
      "k%sTrees{{\n",
      by.c_str(), name.c_str(), inCpp(fitted.prior).c_str(), more.c_str(), Levels, fitted.trees.size(),
      name.c_str());
  for (const BoostedTree<Levels>& tree : fitted.trees) {
    std::vector<std::string> splits, leaves;
    for (const auto& [feature, most] : tree.splits) {
      const bool is_split = most < std::numeric_limits<float>::max();
      splits.push_back(
          fmt::format("{{{}, {}}}", static_cast<int>(feature), is_split ? inCpp(most) : "1e30F"));
    }
    for (const float leaf : tree.leaves) leaves.push_back(inCpp(leaf));
    std::printf("    {{{%s}}, {%s}},\n", fmt::format("{}", fmt::join(splits, ", ")).c_str(),
                fmt::format("{}", fmt::join(leaves, ", ")).c_str());
  }
  std::printf("}};\n// clang-format on\n\n}  // namespace scantrove\n");
}

}  // namespace scantrove::benchmarks
