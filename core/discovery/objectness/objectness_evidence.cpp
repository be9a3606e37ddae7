#include "core/discovery/objectness/objectness_evidence.h"

#include <algorithm>

#include "core/discovery/objectness/objectness_features.h"
#include "embedded/objectness_model.h"

namespace scantrove {

namespace {

/// Of what is mostly a support: tables, shelves and floors carry objects. The model was trained without it.
constexpr float kMostlySupport = 0.6F, kOddsOfSupport = -4;

}  // namespace

float ObjectnessEvidence::logOdds() const {
  static const BoostedTrees model = BoostedTrees::embedded(models::objectness, namesOf(kObjectnessFeatures));
  std::array values = valuesOf(kObjectnessFeatures, *this);
  const float by_model = model.logOdds(values);
  return support > kMostlySupport ? std::min(by_model, kOddsOfSupport) : by_model;
}

}  // namespace scantrove
