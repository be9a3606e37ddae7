#include "core/discovery/objectness/objectness_evidence.h"

#include "core/discovery/objectness/objectness_model.h"

namespace scantrove {

float ObjectnessEvidence::logOdds() const { return logOdds(ObjectnessModel::embedded()); }

float ObjectnessEvidence::logOdds(const ObjectnessModel& model) const {
  const float by_model = model.logOdds(*this);
  return model.readsSupport() ? by_model : supportRule(by_model, support);
}

}  // namespace scantrove
