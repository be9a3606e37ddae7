#pragma once
#include <memory>

#include "core/discovery/candidate_finder.h"

namespace scantrove {

/// Applies the rules of thesis 5.1 (central, persistent in size, size in range, not flat, not eccentric, off
/// the border) to regions and to sets of neighbours (ch. 6). Decides which of the accepted ones are complete.
[[nodiscard]] std::unique_ptr<CandidateFinder> makeRuleBasedFinder(const DiscoveryParams& params);

}  // namespace scantrove
