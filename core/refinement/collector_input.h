#pragma once
#include <vector>

#include "core/collection/object_collector.h"
#include "core/editing/region_notes.h"
#include "core/labeling/region_table.h"
#include "core/pipeline/frame_result.h"

namespace scantrove {

/// Gives the collector what a frame shows before it collects: which regions are in view. Returns the
/// candidates of the frame without those that users said are none, or hold a part that is a thing of its own,
/// and with those that users wait for, whatever the rules say of them. `least_points`: DiscoveryParams.
[[nodiscard]] std::vector<Candidate> candidatesFor(ObjectCollector& collector, const FrameResult& result,
                                                   const RegionNotes& notes, int least_points);

/// The regions that users wait for and that no candidate holds yet, as `input` shows them.
void addRequested(const ObjectCollector& collector, const DiscoveryInput& input, int least_points,
                  std::vector<Candidate>& candidates);

/// The collector learns what became of regions.
void follow(ObjectCollector& collector, const RegionEvents& events, ObjectCollector::JoinedBy by);

}  // namespace scantrove
