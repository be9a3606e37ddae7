#pragma once
#include <span>
#include <string>

#include "core/base/result.h"
#include "tools/train/samples.h"

namespace scantrove::train {

/// Where samples come from, for a model's provenance.
struct Provenance {
  std::string commit, scenes;
};

/// Text of resources/models/objectness.json. Scenes are left out in turn to measure it. `trees`: fewer for a
/// quick trial.
[[nodiscard]] Result<std::string> trainObjectness(std::span<const SceneSamples> scenes,
                                                  const Provenance& provenance, int trees);
/// Text of resources/models/border.json, likewise.
[[nodiscard]] Result<std::string> trainBorder(std::span<const SceneSamples> scenes,
                                              const Provenance& provenance, int trees);

}  // namespace scantrove::train
