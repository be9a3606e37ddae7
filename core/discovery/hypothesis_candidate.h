#pragma once
#include "core/discovery/candidate.h"
#include "core/discovery/candidate_finder.h"
#include "core/discovery/oriented_box.h"
#include "core/discovery/region_hypotheses.h"

namespace scantrove {

/// The hypothesis as the look of `input` shows it, of which `box` is the shape; what is said of its outline,
/// and whether it is whole, is left open.
[[nodiscard]] Candidate candidateOf(const RegionHypothesis& hypothesis, const OrientedBox& box,
                                    const DiscoveryInput& input);

}  // namespace scantrove
