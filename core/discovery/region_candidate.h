#pragma once
#include <optional>

#include "core/discovery/candidate.h"
#include "core/discovery/candidate_finder.h"
#include "core/discovery/oriented_box.h"
#include "core/discovery/region_hypotheses.h"

namespace scantrove {

/// The candidate of a hypothesis as `input` shows it, with the shape `box`. Leaves outline and completeness
/// unset.
[[nodiscard]] Candidate candidateOf(const RegionHypothesis& hypothesis, const OrientedBox& box,
                                    const DiscoveryInput& input);

/// A region that a person asks for as a candidate, without applying the rules. None if fewer than
/// `least_points` of its pixels have a surface in this image.
[[nodiscard]] std::optional<Candidate> candidateOf(RegionId region, const DiscoveryInput& input,
                                                   int least_points);

}  // namespace scantrove
