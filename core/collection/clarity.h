#pragma once
#include "core/discovery/candidate.h"

namespace scantrove {

/// Thresholds for how clearly a candidate shows an object.
struct Clarity {
  float least_outline;  ///< of the candidate's outline that is its own
  float most_hidden;
  float
      least_objectness;  ///< applies to a rated candidate (Candidate::objectness), which must not be cut off
};
/// Thresholds to add a new object, and stricter ones to store a further view, of which there are many to
/// choose from.
constexpr Clarity kForObject{.least_outline = 0.85F, .most_hidden = 0.30F, .least_objectness = 0.7F};
constexpr Clarity kForView{.least_outline = 0.90F, .most_hidden = 0.25F, .least_objectness = 0.5F};

inline bool isClear(const Candidate& candidate, const Clarity& requested) {
  if (candidate.objectness)
    return *candidate.objectness >= requested.least_objectness && !candidate.is_cut_off;
  return candidate.is_complete && candidate.outline >= requested.least_outline &&
         candidate.hidden <= candidate.mostHidden(requested.most_hidden);
}

}  // namespace scantrove
