#include "core/session/refinement_state.h"

namespace scantrove {

bool canBeRefined(const SessionMetadata& metadata) {
  const auto state = metadata.find(kRefinementKey);
  if (state != metadata.end() && !state->second.empty()) return state->second != kRefinementDone;
  // Earlier versions kept nothing, and refined every scan that came to its end.
  const auto ended = metadata.find("ended");
  return ended == metadata.end() || ended->second.empty();
}

}  // namespace scantrove
