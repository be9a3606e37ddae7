#pragma once
#include "core/discovery/candidate.h"

namespace scantrove {

/// How clearly a look shows a thing.
struct Clarity {
  float least_outline;  ///< that is the thing's own
  float most_hidden;
  float least_wholeness;  ///< of a look at the end (Candidate::wholeness) that does not cut it off
};
/// To say that there is something new; and to be kept as one more view, of which there are many to choose
/// from.
constexpr Clarity kForObject{.least_outline = 0.85F, .most_hidden = 0.30F, .least_wholeness = 0.7F};
constexpr Clarity kForView{.least_outline = 0.90F, .most_hidden = 0.25F, .least_wholeness = 0.5F};

inline bool isClear(const Candidate& candidate, const Clarity& wanted) {
  if (candidate.wholeness) return *candidate.wholeness >= wanted.least_wholeness && !candidate.is_cut_off;
  return candidate.is_whole && candidate.outline >= wanted.least_outline &&
         candidate.hidden <= candidate.mostHidden(wanted.most_hidden);
}

}  // namespace scantrove
