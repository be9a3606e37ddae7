#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/boosted_trees.h"
#include "tools/train/samples.h"

namespace scantrove::train {

/// One example with a known answer.
struct Example {
  std::vector<float> x;  ///< features in the model's order; NaN: not known
  bool is_yes = false;
  float weight = 1;
};

struct BoostingParams {
  int trees = 300;
  int levels = 5;
  double learning_rate = 0.1;
  double ridge = 5;         ///< on each leaf
  double min_hessian = 10;  ///< of a leaf
  double feature_part = 1;  ///< that each tree may use, drawn at random
  /// By feature: 1 where more of it must never make a yes less likely, -1 never more likely, 0 either.
  std::vector<int> directions = {};
};

/// Where samples come from.
struct Provenance {
  std::string commit, scenes;
};
[[nodiscard]] Provenance provenanceOf(std::span<const SceneSamples> scenes);

/// What a model's file says beside its numbers.
struct ModelDescription {
  std::string question;
  std::vector<std::string_view> features;
  Provenance provenance;
  std::string held_out;  ///< how good it is on scenes that it was not trained on
};

/// Trains trees with XGBoost; the same examples give the same trees. Returns a model file's text.
/// Error: XGBoost refused.
[[nodiscard]] Result<std::string> trainModel(std::span<const Example> examples, const BoostingParams& params,
                                             const ModelDescription& description);

/// The trees of such a text, as the program reads it.
[[nodiscard]] Result<BoostedTrees> readModel(const std::string& text, const ModelDescription& description);

}  // namespace scantrove::train
