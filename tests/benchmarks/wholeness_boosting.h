#pragma once
#include <span>
#include <vector>

#include "core/discovery/boosted_tree.h"
#include "tests/benchmarks/wholeness_sample.h"

namespace scantrove::benchmarks {

/// The trees of WholenessEvidence::logOdds().
struct WholenessTrees {
  float prior = 0;
  std::vector<BoostedTree> trees;
  [[nodiscard]] float oddsOf(const Features& x) const;
};

/// Fits them to samples: logistic loss, Newton's step in each leaf (Friedman 2001; Chen and Guestrin 2016).
[[nodiscard]] WholenessTrees fitTrees(std::span<const WeighedSample> samples);

}  // namespace scantrove::benchmarks
