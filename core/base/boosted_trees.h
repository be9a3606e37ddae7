#pragma once
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace scantrove {

inline constexpr float kUnknownFeature = std::numeric_limits<float>::quiet_NaN();

/// A feature of a learned model: its name in the model's file, and a function that computes its value from
/// evidence.
template <class Evidence>
struct Feature {
  std::string_view name;
  float (*of)(const Evidence&);  ///< may be kUnknownFeature
};

template <class Evidence, std::size_t N>
[[nodiscard]] constexpr std::array<std::string_view, N> namesOf(
    const std::array<Feature<Evidence>, N>& features) {
  std::array<std::string_view, N> names;
  for (std::size_t i = 0; i < N; ++i) names[i] = features[i].name;
  return names;
}

template <class Evidence, std::size_t N>
[[nodiscard]] std::array<float, N> valuesOf(const std::array<Feature<Evidence>, N>& features,
                                            const Evidence& evidence) {
  std::array<float, N> values;
  for (std::size_t i = 0; i < N; ++i) values[i] = features[i].of(evidence);
  return values;
}

/// A file of resources/models, embedded at build time (scantrove_embed_models in Embed.cmake).
struct ModelFile {
  std::string_view path;  ///< relative to the repository root
  std::string_view json;
};

/// Gradient-boosted trees (Friedman 2001). Tree values and the prior add up to the log odds of a positive
/// answer. tools/train writes the file and documents its format.
class BoostedTrees {
 public:
  /// The file's features are found among these by name; it may leave some out. Error: the file is damaged, or
  /// names another feature.
  [[nodiscard]] static Result<BoostedTrees> parse(const ModelFile& file,
                                                  std::span<const std::string_view> features);
  /// Loads an embedded file: an error ends the program.
  [[nodiscard]] static BoostedTrees embedded(const ModelFile& file,
                                             std::span<const std::string_view> features);

  /// `features`: all that parse() was given, in that order. Replaces unknown ones by the medians of the
  /// training samples.
  [[nodiscard]] float logOdds(std::span<float> features) const;

  /// Whether the file names this feature.
  [[nodiscard]] bool reads(std::string_view feature) const;

 private:
  struct Split {
    int feature;
    float limit;  // go left if the value is at most this
  };
  [[nodiscard]] Result<void> read(std::string_view json, std::span<const std::string_view> features);

  std::vector<std::string> names_;  // as in the file
  std::vector<float> medians_;      // NaN: the feature is always known
  float prior_ = 0;
  std::size_t splits_per_tree_ = 0;  // complete trees: the root, its two children, their four, and so on
  std::vector<Split> splits_;        // tree by tree
  std::vector<float> leaves_;        // likewise, from left to right
};

}  // namespace scantrove
