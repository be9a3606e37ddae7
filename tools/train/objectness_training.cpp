#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <set>

#include "core/discovery/objectness/objectness_features.h"
#include "core/refinement/rated_sets.h"
#include "tools/train/cross_validation.h"
#include "tools/train/models.h"

namespace scantrove::train {
namespace {

constexpr float kCompleteOverlap = 0.6F;  // as `scantrove evaluate catalogue` counts
constexpr double kCompletePart = 0.8;     // of a set's observations

constexpr BoostingParams kParams{
    .trees = 300, .levels = 5, .learning_rate = 0.07, .ridge = 20, .min_hessian = 15, .feature_part = 0.4};

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

/// What a catalogue of the scenes that were left out would hold, from each threshold on.
class HeldOut {
 public:
  void add(const SceneSamples& scene, const BoostedTrees& trees) {
    RatedSets rated;
    std::map<RegionSet, int> complete;  // the true object of each
    const std::vector<Example> examples = examplesOf(scene);
    for (std::size_t i = 0; i < examples.size(); ++i) {
      const ObjectnessSample& sample = scene.objectness[i];
      std::vector<float> x = sample.x;
      Candidate candidate;
      for (const std::uint32_t region : sample.regions) candidate.regions.add(RegionId{region});
      candidate.objectness = trees.logOdds(x);
      candidate.size_m[0] = std::exp(sample.x[kLogLongestSide]);
      rated.add(sample.frame, {&candidate, 1});
      judged_.emplace_back(*candidate.objectness, examples[i].is_yes);
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
  [[nodiscard]] std::string text() const {
    for (const auto& [tenths, result] : at_)
      std::fprintf(stderr, "log odds from %4.1f: %s\n", tenths / 10.0, textAt(tenths).c_str());
    return fmt::format("{} folds by scene: area under the curve {:.3f}, from log odds -0.2 on {}", kFolds,
                       areaUnderCurve(judged_), textAt(-2));
  }

 private:
  static constexpr std::size_t kLogLongestSide = static_cast<std::size_t>(
      std::ranges::find(kObjectnessFeatures, "log_longest_side", &Feature<ObjectnessEvidence>::name) -
      kObjectnessFeatures.begin());

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

  std::vector<std::pair<float, bool>> judged_;
  std::map<int, Counts> at_{{-8, {}}, {-6, {}}, {-4, {}}, {-2, {}}, {0, {}}, {2, {}}, {4, {}}, {6, {}}};
  std::size_t objects_ = 0;
};

}  // namespace

Result<std::string> trainObjectness(std::span<const SceneSamples> scenes, const Provenance& provenance,
                                    int trees) {
  constexpr auto kNames = namesOf(kObjectnessFeatures);
  ModelDescription description{"Are these regions one complete object, seen as such?",
                               {kNames.begin(), kNames.end()},
                               provenance.commit,
                               provenance.scenes,
                               ""};
  BoostingParams params = kParams;
  params.trees = std::min(params.trees, trees);
  HeldOut held_out;
  SCANTROVE_TRY(crossValidate(
      scenes, params, description, [&](std::size_t fold) { return examplesOf(scenes, fold); },
      [&](const SceneSamples& scene, const BoostedTrees& model) { held_out.add(scene, model); }));
  description.held_out = held_out.text();
  return trainModel(examplesOf(scenes, kFolds), params, description);
}

}  // namespace scantrove::train
