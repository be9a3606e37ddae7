#include "core/discovery/objectness/objectness_evidence.h"

#include "core/discovery/objectness/objectness_features.h"
#include "embedded/objectness_model.h"

namespace scantrove {

float ObjectnessEvidence::logOdds() const {
  static const BoostedTrees model = BoostedTrees::embedded(models::objectness, namesOf(kObjectnessFeatures));
  std::array values = valuesOf(kObjectnessFeatures, *this);
  return model.logOdds(values);
}

}  // namespace scantrove
