#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "tools/train/samples.h"

namespace scantrove::train {

struct TrainingOptions {
  int trees = 300;                    ///< at most so many, for a quick trial
  std::vector<std::string> left_out;  ///< features that the models do not read
};

struct TrainedModel {
  std::string file;     ///< text of resources/models/NAME.json
  std::string figures;  ///< how good it is on scenes that it was not trained on, for a person to read
};

/// The objectness model. `scenes` of one number of frames, two at least. The figures compare models with and
/// without the evidence of supports, and the latter with supportRule(). Error: XGBoost refused, or all
/// samples have the same answer.
[[nodiscard]] Result<TrainedModel> trainObjectness(std::span<const SceneSamples> scenes,
                                                   const TrainingOptions& options);
/// The border model, likewise, with outlineRule().
[[nodiscard]] Result<TrainedModel> trainBorder(std::span<const SceneSamples> scenes,
                                               const TrainingOptions& options);

}  // namespace scantrove::train
