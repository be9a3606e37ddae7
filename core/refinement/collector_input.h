#pragma once
#include <vector>

#include "core/collection/object_collector.h"
#include "core/editing/region_notes.h"
#include "core/labeling/region_table.h"
#include "core/pipeline/frame_result.h"

namespace scantrove {

/// Tells the collector which regions a frame shows. Returns the frame's candidates, without those that
/// users rejected or that hold a separate thing, and with the requested ones, whatever the rules say.
/// `least_points`: DiscoveryParams.
[[nodiscard]] std::vector<Candidate> candidatesFor(ObjectCollector& collector, const FrameResult& result,
                                                   const RegionNotes& notes, int least_points);

/// Drops candidates that users marked as background or rejected, or that hold a separate thing.
void leaveOutRejected(const ObjectCollector& collector, const RegionNotes& notes,
                      std::vector<Candidate>& candidates);

/// Requested regions in `input` that no candidate holds yet.
void addRequested(const ObjectCollector& collector, const DiscoveryInput& input, int least_points,
                  std::vector<Candidate>& candidates);

/// Tells the collector about changes of regions. `operation`: of a user's join; see
/// ObjectCollector::joinRegions().
void applyRegionEvents(ObjectCollector& collector, const RegionEvents& events, ObjectCollector::JoinedBy by,
                       int operation = 0);

}  // namespace scantrove
