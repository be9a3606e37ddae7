#pragma once
#include <optional>

#include "core/discovery/candidate.h"
#include "core/discovery/candidate_finder.h"
#include "core/discovery/oriented_box.h"
#include "core/discovery/region_hypotheses.h"

namespace scantrove {

/// The hypothesis as the look of `input` shows it, of which `box` is the shape; what is said of its outline,
/// and whether it is whole, is left open.
[[nodiscard]] Candidate candidateOf(const RegionHypothesis& hypothesis, const OrientedBox& box,
                                    const DiscoveryInput& input);

/// One region as a candidate, whole or not, whatever the rules say of it: for those that a person asks for.
/// None: fewer than `least_points` of its pixels have a surface in this image.
[[nodiscard]] std::optional<Candidate> candidateOf(RegionId region, const DiscoveryInput& input,
                                                   int least_points);

}  // namespace scantrove
