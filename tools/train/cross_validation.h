#pragma once
#include <algorithm>
#include <span>

#include "tools/train/boosting.h"
#include "tools/train/figures.h"
#include "tools/train/samples.h"

namespace scantrove::train {

inline constexpr std::size_t kFolds = 5;

/// Log odds of each sample of each scene.
using SceneOdds = std::vector<std::vector<float>>;

/// Log odds of each scene's samples by a model that was trained on the scenes of the other folds. Scene i is
/// in fold i % kFolds. `examples_without(fold)` gives std::vector<Example>; `odds_of(scene, model)` gives the
/// log odds of its samples. Error: XGBoost refused, or there are too few scenes.
template <class ExamplesWithout, class OddsOf>
[[nodiscard]] Result<SceneOdds> crossValidate(std::span<const SceneSamples> scenes,
                                              const BoostingParams& params,
                                              const ModelDescription& description,
                                              const ExamplesWithout& examples_without,
                                              const OddsOf& odds_of) {
  SceneOdds odds(scenes.size());
  for (std::size_t fold = 0; fold < std::min(kFolds, scenes.size()); ++fold) {
    const auto text = trainModel(examples_without(fold), params, description);
    if (!text) return fail(text.error());
    const auto model = readModel(*text, description);
    if (!model) return fail(model.error());
    for (std::size_t i = fold; i < scenes.size(); i += kFolds) odds[i] = odds_of(scenes[i], *model);
  }
  return odds;
}

/// "5 folds by scene: log loss 0.2345, area under the curve 0.9876", for a model's file.
[[nodiscard]] std::string heldOutText(std::span<const Answer> answers, std::span<const float> log_odds);

/// The numbers of all scenes, one after another.
[[nodiscard]] std::vector<float> inOneRow(const SceneOdds& odds);

}  // namespace scantrove::train
