#pragma once
#include <optional>

#include "core/discovery/candidate.h"
#include "core/discovery/candidate_finder.h"

namespace scantrove {

/// One region as a candidate, whole or not, whatever the rules say of it: for those that a person asks for.
/// None: fewer than `least_points` of its pixels have a surface in this image.
[[nodiscard]] std::optional<Candidate> candidateOf(RegionId region, const DiscoveryInput& input,
                                                   int least_points);

}  // namespace scantrove
