#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <map>
#include <set>

#include "core/discovery/objectness/objectness_model.h"
#include "core/refinement/rated_sets.h"
#include "tools/train/cross_validation.h"
#include "tools/train/feature_choice.h"
#include "tools/train/models.h"

namespace scantrove::train {
namespace {

constexpr float kCompleteOverlap = 0.6F;  // as `scantrove evaluate catalogue` counts
constexpr double kCompletePart = 0.8;     // of a set's observations

constexpr std::size_t objectnessIndexOf(std::string_view name) {
  return static_cast<std::size_t>(
      std::ranges::find(kObjectnessFeatures, name, &Feature<ObjectnessEvidence>::name) -
      kObjectnessFeatures.begin());
}
constexpr std::size_t kLogLongestSide = objectnessIndexOf("log_longest_side");
constexpr std::size_t kSupport = objectnessIndexOf("support"), kCarried = objectnessIndexOf("carried");

/// A set of regions would do as an object of the catalogue if it is one complete object in most of its
/// observations. These are alike: together they weigh as the root of their number.
std::vector<Example> examplesOf(const SceneSamples& scene) {
  struct Counts {
    int all = 0, complete = 0;
  };
  std::map<std::vector<std::uint32_t>, Counts> sets;
  for (const ObjectnessSample& sample : scene.objectness) {
    Counts& counts = sets[sample.regions];
    ++counts.all;
    counts.complete += sample.overlap > kCompleteOverlap ? 1 : 0;
  }
  std::vector<Example> examples;
  for (const ObjectnessSample& sample : scene.objectness) {
    const Counts& counts = sets[sample.regions];
    examples.push_back({sample.x, counts.complete >= kCompletePart * counts.all,
                        1 / std::sqrt(static_cast<float>(counts.all))});
  }
  return examples;
}

/// Examples of the scenes, but those of one fold (kFolds: of none), of mean weight 1.
std::vector<Example> examplesOf(std::span<const SceneSamples> scenes, std::size_t but_fold) {
  std::vector<Example> all;
  float weight = 0;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    if (i % kFolds == but_fold) continue;
    for (Example& example : examplesOf(scenes[i])) {
      weight += example.weight;
      all.push_back(std::move(example));
    }
  }
  for (Example& example : all) example.weight *= static_cast<float>(all.size()) / weight;
  return all;
}

/// What a catalogue of scenes would hold, from each threshold on, by a model that was not trained on them.
class HeldOutCatalogue {
 public:
  void add(const SceneSamples& scene, std::span<const float> log_odds) {
    RatedSets rated;
    std::map<RegionSet, int> complete;  // the true object of each
    const std::vector<Example> examples = examplesOf(scene);
    for (std::size_t i = 0; i < examples.size(); ++i) {
      const ObjectnessSample& sample = scene.objectness[i];
      Candidate candidate;
      for (const std::uint32_t region : sample.regions) candidate.regions.add(RegionId{region});
      candidate.objectness = log_odds[i];
      candidate.size_m[0] = std::exp(sample.x[kLogLongestSide]);
      rated.add(sample.frame, {&candidate, 1});
      if (examples[i].is_yes) complete[candidate.regions] = sample.object;
    }
    std::set<int> objects;
    for (const auto& [regions, object] : complete) objects.insert(object);
    objects_ += objects.size();
    for (auto& [tenths, result] : at_) {
      std::set<int> found;
      for (const RatedSets::Rated& chosen : rated.disjoint(static_cast<float>(tenths) / 10)) {
        ++result.chosen;
        const auto object = complete.find(chosen.regions);
        if (object == complete.end()) continue;
        ++result.complete;
        found.insert(object->second);
      }
      result.found += found.size();
    }
  }
  /// A line for each threshold.
  [[nodiscard]] std::string table() const {
    std::string text;
    for (const auto& [tenths, result] : at_)
      text += fmt::format("  log odds from {:4.1f}: {}\n", tenths / 10.0, textAt(tenths));
    return text;
  }
  /// At the threshold of the refinement.
  [[nodiscard]] std::string text() const { return "from log odds -0.2 on " + textAt(-2); }

 private:
  struct Counts {
    std::size_t chosen = 0, complete = 0, found = 0;
  };
  [[nodiscard]] std::string textAt(int tenths) const {
    const Counts& result = at_.at(tenths);
    const auto part = [](std::size_t of, std::size_t all) {
      return static_cast<double>(of) / static_cast<double>(std::max<std::size_t>(all, 1));
    };
    return fmt::format("purity {:.3f} of {}, completeness {:.3f} of {}", part(result.complete, result.chosen),
                       result.chosen, part(result.found, objects_), objects_);
  }

  std::map<int, Counts> at_{{-8, {}}, {-6, {}}, {-4, {}}, {-2, {}}, {0, {}}, {2, {}}, {4, {}}, {6, {}}};
  std::size_t objects_ = 0;
};

HeldOutCatalogue catalogueOf(std::span<const SceneSamples> scenes, std::span<const float> log_odds) {
  HeldOutCatalogue catalogue;
  for (const SceneSamples& scene : scenes) {
    catalogue.add(scene, log_odds.first(scene.objectness.size()));
    log_odds = log_odds.subspan(scene.objectness.size());
  }
  return catalogue;
}

/// An objectness model of chosen features.
class ObjectnessTraining {
 public:
  ObjectnessTraining(std::span<const SceneSamples> scenes, const FeatureChoice& choice, int trees)
      : scenes_(scenes), choice_(choice), trees_(trees) {}

  /// Of all samples, by models that were not trained on their scenes.
  [[nodiscard]] Result<std::vector<float>> heldOutOdds() const {
    const auto odds = crossValidate(
        scenes_, params(), description(""), [this](std::size_t fold) { return examplesWithout(fold); },
        [this](const SceneSamples& scene, const BoostedTrees& model) {
          std::vector<float> of_scene;
          for (const ObjectnessSample& sample : scene.objectness) {
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
    BoostingParams params{.trees = std::min(300, trees_),
                          .levels = 5,
                          .learning_rate = 0.07,
                          .ridge = 20,
                          .min_hessian = 15,
                          .feature_part = 0.4};
    // A support is never more likely an object than what is none, whatever few examples say.
    for (const std::string_view name : choice_.names())
      params.directions.push_back(name == "support" ? -1 : 0);
    return params;
  }
  [[nodiscard]] ModelDescription description(const std::string& held_out) const {
    return {"Are these regions one complete object, seen as such?", choice_.names(), provenanceOf(scenes_),
            held_out};
  }
  [[nodiscard]] std::vector<Example> examplesWithout(std::size_t fold) const {
    std::vector<Example> examples = examplesOf(scenes_, fold);
    for (Example& example : examples) example.x = choice_.of(example.x);
    return examples;
  }

  std::span<const SceneSamples> scenes_;
  const FeatureChoice& choice_;
  int trees_;
};

std::vector<Answer> objectnessAnswers(std::span<const SceneSamples> scenes) {
  std::vector<Answer> answers;
  for (const SceneSamples& scene : scenes) {
    const std::vector<Example> examples = examplesOf(scene);
    for (std::size_t i = 0; i < examples.size(); ++i) {
      const std::vector<float>& x = scene.objectness[i].x;
      answers.push_back({examples[i].is_yes, examples[i].weight, kindOf(scene.origin.scene),
                         x[kSupport] + x[kCarried] > 0});
    }
  }
  return answers;
}

/// Log odds as ObjectnessEvidence::logOdds() has them for models that do not read `support`.
std::vector<float> withSupportRule(std::span<const SceneSamples> scenes, std::vector<float> odds) {
  auto of_sample = odds.begin();
  for (const SceneSamples& scene : scenes) {
    for (const ObjectnessSample& sample : scene.objectness) {
      *of_sample = supportRule(*of_sample, sample.x[kSupport]);
      ++of_sample;
    }
  }
  return odds;
}

}  // namespace

Result<TrainedModel> trainObjectness(std::span<const SceneSamples> scenes, const TrainingOptions& options) {
  const auto train = [&](const FeatureChoice& choice) {
    return ObjectnessTraining(scenes, choice, options.trees);
  };
  const FeatureChoice chosen(kObjectnessFeatures, options.left_out);
  std::vector<std::string_view> old_left_out(kSupportFeatures.begin(), kSupportFeatures.end());
  old_left_out.insert(old_left_out.end(), options.left_out.begin(), options.left_out.end());
  const FeatureChoice old_features(kObjectnessFeatures, old_left_out);
  const auto old_odds = train(old_features).heldOutOdds();
  if (!old_odds) return fail(old_odds.error());
  const std::vector<Answer> answers = objectnessAnswers(scenes);
  Figures figures(answers);
  std::string catalogues;
  HeldOutCatalogue catalogue;
  const auto add = [&](const std::string& name, const std::vector<float>& odds) {
    figures.add(name, odds);
    catalogue = catalogueOf(scenes, odds);
    catalogues += name + ":\n" + catalogue.table();
  };
  add("without supports", *old_odds);
  std::vector<float> odds = withSupportRule(scenes, *old_odds);
  add("rule for supports", odds);
  if (chosen.hasAnyOf(kSupportFeatures)) {
    SCANTROVE_TRY(moveInto(odds, train(chosen).heldOutOdds()));
    add("supports read", odds);
  }
  const auto file = train(chosen).model(heldOutText(answers, odds) + ", " + catalogue.text());
  if (!file) return fail(file.error());
  return TrainedModel{*file, figures.table() + catalogues};
}

}  // namespace scantrove::train
