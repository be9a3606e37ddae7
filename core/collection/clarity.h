#pragma once
#include "core/discovery/candidate.h"

namespace scantrove {

/// How clearly a candidate shows an object.
struct Clarity {
  float least_outline;  ///< that is the candidate's own
  float most_hidden;
  float least_objectness;  ///< of a candidate that is rated (Candidate::objectness) and not cut off
};
/// To add a new object; and to store one more view, of which there are many to choose from.
constexpr Clarity kForObject{.least_outline = 0.85F, .most_hidden = 0.30F, .least_objectness = 0.7F};
constexpr Clarity kForView{.least_outline = 0.90F, .most_hidden = 0.25F, .least_objectness = 0.5F};

inline bool isClear(const Candidate& candidate, const Clarity& requested) {
  if (candidate.objectness)
    return *candidate.objectness >= requested.least_objectness && !candidate.is_cut_off;
  return candidate.is_complete && candidate.outline >= requested.least_outline &&
         candidate.hidden <= candidate.mostHidden(requested.most_hidden);
}

}  // namespace scantrove
