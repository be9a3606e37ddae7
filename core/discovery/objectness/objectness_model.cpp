#include "core/discovery/objectness/objectness_model.h"

#include <algorithm>
#include <utility>

#include "embedded/objectness_model.h"

namespace scantrove {

ObjectnessModel::ObjectnessModel(BoostedTrees trees)
    : trees_(std::move(trees)), reads_support_(trees_.reads("support")) {}

Result<ObjectnessModel> ObjectnessModel::parse(const ModelFile& file) {
  Result<BoostedTrees> trees = BoostedTrees::parse(file, namesOf(kObjectnessFeatures));
  if (!trees) return fail(std::move(trees).error());
  return ObjectnessModel(std::move(*trees));
}

const ObjectnessModel& ObjectnessModel::embedded() {
  static const ObjectnessModel model(
      BoostedTrees::embedded(models::objectness, namesOf(kObjectnessFeatures)));
  return model;
}

float ObjectnessModel::logOdds(const ObjectnessEvidence& evidence) const {
  std::array values = valuesOf(kObjectnessFeatures, evidence);
  return trees_.logOdds(values);
}

float supportRule(float log_odds, float support) {
  constexpr float kMostlySupport = 0.6F, kOddsOfSupport = -4;
  return support > kMostlySupport ? std::min(log_odds, kOddsOfSupport) : log_odds;
}

}  // namespace scantrove
