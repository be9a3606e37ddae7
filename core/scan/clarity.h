#pragma once
#include "core/discovery/candidate.h"

namespace scantrove {

/// How clearly a look shows a thing.
struct Clarity {
  float least_outline;  ///< that is the thing's own
  float most_hidden;
};
/// To say that there is something new; and to be kept as one more view, of which there are many to choose
/// from.
constexpr Clarity kForObject{.least_outline = 0.85F, .most_hidden = 0.30F};
constexpr Clarity kForView{.least_outline = 0.90F, .most_hidden = 0.25F};

inline bool isClear(const Candidate& candidate, const Clarity& wanted) {
  return candidate.is_whole && candidate.outline >= wanted.least_outline &&
         candidate.hidden <= candidate.mostHidden(wanted.most_hidden);
}

}  // namespace scantrove
