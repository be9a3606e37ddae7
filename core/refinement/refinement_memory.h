#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/editing/operation_log.h"
#include "core/refinement/refinement_position.h"
#include "core/session/saved_scan.h"

namespace scantrove {

/// What a session keeps of a refinement that was left for later.
struct RefinementMemory {
  RefinementPosition position;
  std::vector<std::uint32_t> collector;  ///< of collectorMemory()
  std::vector<RegionId> known;           ///< RegionTable::isKnown
};

/// Of one that is done, or of which nothing is kept yet.
[[nodiscard]] SessionMetadata refinementMetadata(bool is_done);
/// `operations`: what persons did to the regions by then.
[[nodiscard]] SessionMetadata refinementMetadata(const RefinementMemory& memory,
                                                 std::span<const OperationLog::Entry> operations);

/// None: nothing is kept. When persons have done something to the regions since, what was rated is rated
/// again.
[[nodiscard]] std::optional<RefinementMemory> refinementMemoryFrom(
    const SessionMetadata& metadata, std::span<const OperationLog::Entry> operations);

}  // namespace scantrove
