#include "tests/benchmarks/wholeness_boosting.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace scantrove::benchmarks {
namespace {

constexpr std::size_t kTrees = 300;
constexpr double kLearningRate = 0.07, kRidge = 20;
constexpr int kLeastSamples = 120;       // of a leaf
constexpr double kPartOfFeatures = 0.4;  // that a tree may ask for, by chance: the trees differ more
constexpr std::size_t kBins = 64;        // of a feature's values, as many in each

/// Samples by feature and bin, so that splits are found by sums over bins.
class Bins {
 public:
  explicit Bins(std::span<const WeighedSample> samples) {
    for (std::size_t f = 0; f < limits_.size(); ++f) {
      std::vector<float> values;
      for (const WeighedSample& sample : samples) values.push_back(sample.sample->x[f]);
      std::ranges::sort(values);
      for (std::size_t b = 1; b < kBins; ++b) {
        const std::size_t at = b * values.size() / kBins;
        const float limit = (values[at - 1] + values[at]) / 2;
        if (limit < values.back() && (limits_[f].empty() || limit > limits_[f].back()))
          limits_[f].push_back(limit);
      }
      for (const WeighedSample& sample : samples) bins_[f].push_back(binOf(f, sample.sample->x[f]));
    }
  }
  [[nodiscard]] std::size_t of(std::size_t feature, std::size_t sample) const {
    return bins_[feature][sample];
  }
  /// The highest value of each bin but the last.
  [[nodiscard]] const std::vector<float>& limits(std::size_t feature) const { return limits_[feature]; }

 private:
  [[nodiscard]] std::size_t binOf(std::size_t feature, float value) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(limits_[feature], value) -
                                    limits_[feature].begin());
  }
  std::array<std::vector<float>, WholenessEvidence::kFeatures> limits_;
  std::array<std::vector<std::size_t>, WholenessEvidence::kFeatures> bins_;
};

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
  [[nodiscard]] double gain() const { return first * first / (second + kRidge); }
  [[nodiscard]] float value() const { return static_cast<float>(-kLearningRate * first / (second + kRidge)); }
};

class Boosting {
 public:
  explicit Boosting(std::span<const WeighedSample> samples)
      : samples_(samples), bins_(samples), odds_(samples.size()) {
    double all = 0, whole = 0;
    for (const WeighedSample& sample : samples) {
      all += static_cast<double>(sample.weight);
      whole += sample.is_whole ? static_cast<double>(sample.weight) : 0;
    }
    fitted_.prior = static_cast<float>(std::log(whole / (all - whole)));
    std::ranges::fill(odds_, fitted_.prior);
    for (std::size_t i = 0; i < kTrees; ++i) addTree();
  }
  [[nodiscard]] WholenessTrees fitted() && { return std::move(fitted_); }

 private:
  [[nodiscard]] Slope slopeAt(std::size_t i) const {
    const double p = 1 / (1 + std::exp(-static_cast<double>(odds_[i])));
    const auto weight = static_cast<double>(samples_[i].weight);
    return {weight * (p - (samples_[i].is_whole ? 1 : 0)), weight * p * (1 - p), 1};
  }
  void addTree() {
    std::vector<Slope> slopes;
    for (std::size_t i = 0; i < samples_.size(); ++i) slopes.push_back(slopeAt(i));
    const std::vector<std::size_t> features = drawFeatures();
    BoostedTree tree{};
    std::vector<std::vector<std::size_t>> nodes(BoostedTree::kSplits + BoostedTree::kLeaves);
    nodes[0].resize(samples_.size());
    std::iota(nodes[0].begin(), nodes[0].end(), std::size_t{0});
    for (std::size_t node = 0; node < BoostedTree::kSplits; ++node) {
      tree.splits[node] = bestSplit(nodes[node], slopes, features);
      const auto [feature, most] = tree.splits[node];
      for (const std::size_t i : nodes[node]) {
        const bool is_left = samples_[i].sample->x[static_cast<std::size_t>(feature)] <= most;
        nodes[2 * node + (is_left ? 1 : 2)].push_back(i);
      }
    }
    for (std::size_t leaf = 0; leaf < BoostedTree::kLeaves; ++leaf) {
      Slope all;
      for (const std::size_t i : nodes[BoostedTree::kSplits + leaf]) all += slopes[i];
      tree.leaves[leaf] = all.value();
    }
    for (std::size_t i = 0; i < samples_.size(); ++i) odds_[i] += tree.valueOf(samples_[i].sample->x);
    fitted_.trees.push_back(tree);
  }
  [[nodiscard]] std::vector<std::size_t> drawFeatures() {
    std::vector<std::size_t> features(WholenessEvidence::kFeatures);
    std::iota(features.begin(), features.end(), std::size_t{0});
    const auto drawn = static_cast<std::size_t>(kPartOfFeatures * static_cast<double>(features.size()));
    for (std::size_t i = 0; i < drawn; ++i)
      std::swap(features[i], features[i + random_() % (features.size() - i)]);
    features.resize(drawn);
    return features;
  }
  /// Where nothing is gained all go to the left.
  [[nodiscard]] BoostedTree::Split bestSplit(const std::vector<std::size_t>& node,
                                             const std::vector<Slope>& slopes,
                                             const std::vector<std::size_t>& features) const {
    BoostedTree::Split best{0, std::numeric_limits<float>::max()};
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
        if (left.count < kLeastSamples || right.count < kLeastSamples) continue;
        const double gain = left.gain() + right.gain() - all.gain();
        if (gain <= most) continue;
        most = gain;
        best = {static_cast<std::int8_t>(feature), limits[bin]};
      }
    }
    return best;
  }

  std::span<const WeighedSample> samples_;
  Bins bins_;
  std::vector<float> odds_;
  WholenessTrees fitted_;
  std::mt19937 random_;  // as it starts by default: the same trees each time
};

}  // namespace

float WholenessTrees::oddsOf(const Features& x) const {
  return std::accumulate(trees.begin(), trees.end(), prior,
                         [&](float sum, const BoostedTree& tree) { return sum + tree.valueOf(x); });
}

WholenessTrees fitTrees(std::span<const WeighedSample> samples) { return Boosting(samples).fitted(); }

}  // namespace scantrove::benchmarks
