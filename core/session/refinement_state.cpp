#include "core/session/refinement_state.h"

namespace scantrove {

bool canBeRefined(const SessionMetadata& metadata) {
  const auto state = metadata.find(kRefinementKey);
  if (state != metadata.end() && !state->second.empty()) return state->second != kRefinementDone;
  // Earlier versions stored nothing, and refined every scan that reached its end.
  const auto ended = metadata.find("ended");
  return ended == metadata.end() || ended->second.empty();
}

}  // namespace scantrove
