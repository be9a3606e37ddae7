#pragma once
#include <filesystem>
#include <string>
#include <string_view>
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

/// The scan that samples come from.
struct SampleOrigin {
  std::string scene;   ///< as after "demo:"
  int frames = 0;      ///< of the scan
  std::string commit;  ///< of the program that scanned
  bool operator==(const SampleOrigin&) const = default;
};

/// What one scan of one scene gives.
struct SceneSamples {
  SampleOrigin origin;
  std::vector<ObjectnessSample> objectness;
  std::vector<BorderSample> borders;
};

/// Text of a sample file; tools/train/README.md documents its format.
[[nodiscard]] std::string textOf(const SceneSamples& samples);
/// Samples of such a text. Error: names `file`, which is damaged, or holds samples of other features.
[[nodiscard]] Result<SceneSamples> parseSamples(std::string_view text, const std::filesystem::path& file);

/// Error: `file` cannot be written; it is then as before.
[[nodiscard]] Result<void> writeSamples(const std::filesystem::path& file, const SceneSamples& samples);
/// Error: as parseSamples, or `file` cannot be read.
[[nodiscard]] Result<SceneSamples> readSamples(const std::filesystem::path& file);

}  // namespace scantrove::train
