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

/// A feature that a learned model weighs: its name in the model's file, and its value of some evidence.
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
  std::string_view path;  ///< from the repository's root
  std::string_view json;
};

/// Gradient-boosted trees (Friedman 2001), made by tools/train, which describes the file: their values and
/// the prior add up to the logarithm of the odds of a yes to the model's question.
class BoostedTrees {
 public:
  /// Error: the file is damaged, or made for other features than these.
  [[nodiscard]] static Result<BoostedTrees> parse(const ModelFile& file,
                                                  std::span<const std::string_view> features);
  /// Of a file that is part of the program: an error ends the program.
  [[nodiscard]] static BoostedTrees embedded(const ModelFile& file,
                                             std::span<const std::string_view> features);

  /// Unknown features become the medians of the training samples first.
  [[nodiscard]] float logOdds(std::span<float> features) const;

 private:
  struct Split {
    int feature;
    float limit;  // up to this the way goes to the left
  };
  [[nodiscard]] Result<void> read(std::string_view json, std::span<const std::string_view> features);

  std::vector<float> medians_;  // NaN: always known
  float prior_ = 0;
  std::size_t splits_per_tree_ = 0;  // complete trees: the root, its two children, their four, and so on
  std::vector<Split> splits_;        // tree by tree
  std::vector<float> leaves_;        // likewise, from left to right
};

}  // namespace scantrove
