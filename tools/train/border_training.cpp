#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "core/labeling/border_features.h"
#include "tools/train/cross_validation.h"
#include "tools/train/models.h"

namespace scantrove::train {
namespace {

constexpr std::size_t indexOf(std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(kBorderFeatures, name, &Feature<SizedBorder>::name) -
                                  kBorderFeatures.begin());
}

/// A leak heals only if more observations as one never speak against it. Folds and unlike colours never speak
/// for one object, whatever few examples say.
std::vector<int> directions() {
  std::vector<int> directions(kBorderFeatures.size(), 0);
  for (const char* name : {"same_segment_part", "bridged_part", "shared_colors"})
    directions[indexOf(name)] = 1;
  for (const char* name : {"folded", "color_shift", "chroma_difference", "color_difference", "elsewhere"})
    directions[indexOf(name)] = -1;
  return directions;
}

/// Scenes are easier than homes; examples are made harder at random.
class Examples {
 public:
  void add(const SceneSamples& scene) {
    for (const BorderSample& sample : scene.borders) {
      Example example{sample.x, sample.is_same_object, 1};
      if (!example.is_yes) {
        makeHarder(example.x);
      } else if (example.x[kSharedChroma] < kPlain) {
        plain_.push_back(examples_.size());
      }
      examples_.push_back(example);
      if (examples_.size() % kColorlessOf != 0) continue;
      for (const std::size_t f : of_color_) example.x[f] = kUnknownFeature;
      examples_.push_back(std::move(example));
    }
  }
  [[nodiscard]] std::vector<Example> take() { return std::move(examples_); }

 private:
  /// A camera may have no colour: one in so many is repeated without it.
  static constexpr std::size_t kColorlessOf = 4;
  /// Real walls, floors and cupboards share their colours more often: so many of a thousand borders between
  /// two objects get the colours of a border within a plain one.
  static constexpr unsigned kAlikeOfThousand = 50, kLargeAlikeOfThousand = 500;
  static constexpr float kLarge = 5000;  // voxels of the smaller fragment
  static constexpr float kPlain = 10;    // at most so much chroma is shared
  /// A segment may lie over two objects for a while: so many of a thousand borders between two were in one
  /// segment in up to kMaxLeaked of their observations.
  static constexpr unsigned kLeakedOfThousand = 600;
  static constexpr float kMaxLeaked = 0.4F;
  static constexpr std::size_t kSharedChroma = indexOf("shared_chroma"),
                               kFewerVoxels = indexOf("fewer_voxels");

  [[nodiscard]] bool happens(unsigned of_thousand) { return random_() % 1000 < of_thousand; }
  void makeHarder(std::vector<float>& x) {
    const bool are_large = x[kFewerVoxels] > kLarge;
    if (!plain_.empty() && happens(are_large ? kLargeAlikeOfThousand : kAlikeOfThousand)) {
      const Example& other = examples_[plain_[random_() % plain_.size()]];
      for (const std::size_t f : of_color_) x[f] = other.x[f];
    }
    if (!happens(kLeakedOfThousand)) return;
    const float leaked = kMaxLeaked * static_cast<float>(random_() % 1000) / 1000;
    for (const std::size_t f : {indexOf("same_segment_part"), indexOf("bridged_part")})
      x[f] = std::max(x[f], leaked);
  }
  static std::vector<std::size_t> featuresOfColor() {
    std::vector<std::size_t> of_color;
    const BorderEvidence without_color;
    for (std::size_t f = 0; f < kBorderFeatures.size(); ++f) {
      if (std::isnan(kBorderFeatures[f].of({without_color}))) of_color.push_back(f);
    }
    return of_color;
  }

  std::vector<std::size_t> of_color_ = featuresOfColor();
  std::vector<Example> examples_;
  std::vector<std::size_t> plain_;  // of examples_: within one object, and plain
  std::mt19937 random_;             // the same numbers each time
};

}  // namespace

Result<std::string> trainBorder(std::span<const SceneSamples> scenes, const Provenance& provenance,
                                int trees) {
  constexpr auto kNames = namesOf(kBorderFeatures);
  ModelDescription description{"Do these two fragments belong to one object?",
                               {kNames.begin(), kNames.end()},
                               provenance.commit,
                               provenance.scenes,
                               ""};
  const BoostingParams params{.trees = std::min(120, trees),
                              .levels = 4,
                              .learning_rate = 0.12,
                              .ridge = 5,
                              .min_hessian = 15,
                              .feature_part = 0.7,
                              .directions = directions()};
  std::vector<std::pair<float, bool>> judged;
  const auto examplesWithout = [&](std::size_t fold) {
    Examples examples;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      if (i % kFolds != fold) examples.add(scenes[i]);
    }
    return examples.take();
  };
  const auto judge = [&](const SceneSamples& scene, const BoostedTrees& model) {
    for (const BorderSample& sample : scene.borders) {
      std::vector<float> x = sample.x;
      judged.emplace_back(model.logOdds(x), sample.is_same_object);
    }
  };
  SCANTROVE_TRY(crossValidate(scenes, params, description, examplesWithout, judge));
  description.held_out = fmt::format("{} folds by scene: area under the curve {:.4f}", kFolds,
                                     areaUnderCurve(std::move(judged)));
  return trainModel(examplesWithout(kFolds), params, description);
}

}  // namespace scantrove::train
