#include "tools/train/cross_validation.h"

#include <spdlog/fmt/fmt.h>

namespace scantrove::train {

std::string heldOutText(std::span<const Answer> answers, std::span<const float> log_odds) {
  return fmt::format("{} folds by scene: log loss {:.4f}, area under the curve {:.4f}", kFolds,
                     logLoss(answers, log_odds), areaUnderCurve(answers, log_odds));
}

std::vector<float> inOneRow(const SceneOdds& odds) {
  std::vector<float> row;
  for (const std::vector<float>& of_scene : odds) row.insert(row.end(), of_scene.begin(), of_scene.end());
  return row;
}

}  // namespace scantrove::train
