#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "core/labeling/border_model.h"
#include "tools/train/cross_validation.h"
#include "tools/train/feature_choice.h"
#include "tools/train/models.h"

namespace scantrove::train {
namespace {

constexpr std::size_t borderIndexOf(std::string_view name) {
  return static_cast<std::size_t>(std::ranges::find(kBorderFeatures, name, &Feature<SizedBorder>::name) -
                                  kBorderFeatures.begin());
}

/// A leak heals only if more observations as one never speak against it. Folds, unlike colours and outlines
/// on a support never speak for one object, whatever few examples say.
int directionOf(std::string_view feature) {
  for (const char* name : {"same_segment_part", "bridged_part", "shared_colors", "unoutlined"})
    if (feature == name) return 1;
  for (const char* name : {"folded", "color_shift", "chroma_difference", "color_difference", "elsewhere",
                           "outlined", "outlined_part"})
    if (feature == name) return -1;
  return 0;
}

constexpr std::size_t kOutlined = borderIndexOf("outlined"), kUnoutlined = borderIndexOf("unoutlined");

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
  static constexpr std::size_t kSharedChroma = borderIndexOf("shared_chroma"),
                               kFewerVoxels = borderIndexOf("fewer_voxels");

  [[nodiscard]] bool happens(unsigned of_thousand) { return random_() % 1000 < of_thousand; }
  void makeHarder(std::vector<float>& x) {
    const bool are_large = x[kFewerVoxels] > kLarge;
    if (!plain_.empty() && happens(are_large ? kLargeAlikeOfThousand : kAlikeOfThousand)) {
      const Example& other = examples_[plain_[random_() % plain_.size()]];
      for (const std::size_t f : of_color_) x[f] = other.x[f];
    }
    if (!happens(kLeakedOfThousand)) return;
    const float leaked = kMaxLeaked * static_cast<float>(random_() % 1000) / 1000;
    for (const std::size_t f : {borderIndexOf("same_segment_part"), borderIndexOf("bridged_part")})
      x[f] = std::max(x[f], leaked);
    // A segment over both outlines neither.
    const float denied = leaked * x[kOutlined];
    x[kOutlined] -= denied;
    x[kUnoutlined] += denied;
    x[borderIndexOf("outlined_part")] = border::outlinedPart(x[kOutlined], x[kUnoutlined]);
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

/// A border model of chosen features.
class BorderTraining {
 public:
  BorderTraining(std::span<const SceneSamples> scenes, const FeatureChoice& choice, int trees)
      : scenes_(scenes), choice_(choice), trees_(trees) {}

  /// Of all samples, by models that were not trained on their scenes.
  [[nodiscard]] Result<std::vector<float>> heldOutOdds() const {
    const auto odds = crossValidate(
        scenes_, params(), description(""), [this](std::size_t fold) { return examplesWithout(fold); },
        [this](const SceneSamples& scene, const BoostedTrees& model) {
          std::vector<float> of_scene;
          for (const BorderSample& sample : scene.borders) {
            std::vector<float> x = choice_.of(sample.x);
            of_scene.push_back(model.logOdds(x));
          }
          return of_scene;
        });
    if (!odds) return fail(odds.error());
    return inOneRow(*odds);
  }

  /// Of all scenes.
  [[nodiscard]] Result<std::string> model(const std::string& held_out) const {
    return trainModel(examplesWithout(kFolds), params(), description(held_out));
  }

 private:
  [[nodiscard]] BoostingParams params() const {
    BoostingParams params{.trees = std::min(120, trees_),
                          .levels = 4,
                          .learning_rate = 0.12,
                          .ridge = 5,
                          .min_hessian = 15,
                          .feature_part = 0.7};
    for (const std::string_view name : choice_.names()) params.directions.push_back(directionOf(name));
    return params;
  }
  [[nodiscard]] ModelDescription description(const std::string& held_out) const {
    return {"Do these two fragments belong to one object?", choice_.names(), provenanceOf(scenes_), held_out};
  }
  [[nodiscard]] std::vector<Example> examplesWithout(std::size_t fold) const {
    Examples all;
    for (std::size_t i = 0; i < scenes_.size(); ++i) {
      if (i % kFolds != fold) all.add(scenes_[i]);
    }
    std::vector<Example> examples = all.take();
    for (Example& example : examples) example.x = choice_.of(example.x);
    return examples;
  }

  std::span<const SceneSamples> scenes_;
  const FeatureChoice& choice_;
  int trees_;
};

std::vector<Answer> borderAnswers(std::span<const SceneSamples> scenes) {
  std::vector<Answer> answers;
  for (const SceneSamples& scene : scenes) {
    for (const BorderSample& sample : scene.borders)
      answers.push_back({sample.is_same_object, 1, kindOf(scene.origin.scene),
                         sample.x[kOutlined] + sample.x[kUnoutlined] > 0});
  }
  return answers;
}

/// Log odds as BorderEvidence::weight() has them for models that do not read the outlines.
std::vector<float> withOutlineRule(std::span<const SceneSamples> scenes, std::vector<float> odds) {
  auto of_sample = odds.begin();
  for (const SceneSamples& scene : scenes) {
    for (const BorderSample& sample : scene.borders)
      *of_sample++ += outlineRule(sample.x[kOutlined], sample.x[kUnoutlined]);
  }
  return odds;
}

}  // namespace

Result<TrainedModel> trainBorder(std::span<const SceneSamples> scenes, const TrainingOptions& options) {
  const auto train = [&](const FeatureChoice& choice) {
    return BorderTraining(scenes, choice, options.trees);
  };
  const FeatureChoice chosen(kBorderFeatures, options.left_out);
  std::vector<std::string_view> old_left_out(kOutlineFeatures.begin(), kOutlineFeatures.end());
  old_left_out.insert(old_left_out.end(), options.left_out.begin(), options.left_out.end());
  const FeatureChoice old_features(kBorderFeatures, old_left_out);
  const auto old_odds = train(old_features).heldOutOdds();
  if (!old_odds) return fail(old_odds.error());
  Figures figures(borderAnswers(scenes));
  figures.add("without supports", *old_odds);
  std::vector<float> odds = withOutlineRule(scenes, *old_odds);
  figures.add("rule for supports", odds);
  if (chosen.hasAnyOf(kOutlineFeatures)) {
    SCANTROVE_TRY(moveInto(odds, train(chosen).heldOutOdds()));
    figures.add("supports read", odds);
  }
  const auto file = train(chosen).model(heldOutText(borderAnswers(scenes), odds));
  if (!file) return fail(file.error());
  return TrainedModel{*file, figures.table()};
}

}  // namespace scantrove::train
