#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace scantrove::train {

/// Features of one thing to learn from, in the order of the model's feature table; NaN: not known.
struct ObjectnessSample {
  std::vector<std::uint32_t> regions;  ///< rising; of the scene's finest regions
  int frame = 0;
  int object = 0;     ///< true object with the largest overlap; 0: none
  float overlap = 0;  ///< intersection over union with it
  std::vector<float> x;
};
struct BorderSample {
  bool is_same_object = false;
  std::vector<float> x;
};

/// What one scan of one scene gives.
struct SceneSamples {
  std::string scene;
  std::vector<ObjectnessSample> objectness;
  std::vector<BorderSample> borders;
};

/// Error: the disk is full.
[[nodiscard]] Result<void> writeSamples(const std::filesystem::path& file, const SceneSamples& samples);
/// Error: the file holds samples of other features.
[[nodiscard]] Result<SceneSamples> readSamples(const std::filesystem::path& file, const std::string& scene);

}  // namespace scantrove::train
