#pragma once
#include <span>

#include "tools/train/boosting.h"
#include "tools/train/samples.h"

namespace scantrove::train {

inline constexpr std::size_t kFolds = 5;

/// Judges each scene with a model that was trained on the scenes of the other folds. Scene i is in fold i %
/// kFolds. `examples_without(fold)` gives std::vector<Example>; `judge(scene, model)` is called once a scene.
/// Error: XGBoost refused.
template <class ExamplesWithout, class Judge>
[[nodiscard]] Result<void> crossValidate(std::span<const SceneSamples> scenes, const BoostingParams& params,
                                         const ModelDescription& description,
                                         const ExamplesWithout& examples_without, const Judge& judge) {
  for (std::size_t fold = 0; fold < kFolds; ++fold) {
    const auto text = trainModel(examples_without(fold), params, description);
    if (!text) return fail(text.error());
    const auto model = readModel(*text, description);
    if (!model) return fail(model.error());
    for (std::size_t i = fold; i < scenes.size(); i += kFolds) judge(scenes[i], *model);
  }
  return {};
}

}  // namespace scantrove::train
