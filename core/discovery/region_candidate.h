#pragma once
#include <optional>
#include <span>
#include <vector>

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

/// The largest region of the image as the only object of the scan, without applying the rules: nothing else
/// is in the map, so its whole outline is its own. `census`: of the image. None if fewer than `least_points`
/// of its pixels have a surface.
[[nodiscard]] std::optional<Candidate> onlyObject(const RegionCensus& census, const DiscoveryInput& input,
                                                  int least_points);

/// Known objects as candidates, without applying the rules: those of `sets` of which this image shows at
/// least `least_pixels` pixels, in order, with `outline`, `hidden` and `is_cut_off` (a tenth of the outline
/// or more).
[[nodiscard]] std::vector<Candidate> candidatesOf(std::span<const RegionSet> sets,
                                                  const DiscoveryInput& input, double least_pixels);

}  // namespace scantrove
