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

/// A session's memory of a postponed refinement.
struct RefinementMemory {
  RefinementPosition position;
  std::vector<std::uint32_t> collector;  ///< of collectorMemory()
  std::vector<RegionId> known;           ///< RegionTable::isKnown
};

/// For a finished refinement, or one without progress.
[[nodiscard]] SessionMetadata refinementMetadata(bool is_done);
/// `operations`: edits of regions so far.
[[nodiscard]] SessionMetadata refinementMetadata(const RefinementMemory& memory,
                                                 std::span<const OperationLog::Entry> operations);

/// None: nothing is stored. If regions were edited since, ratings start again.
[[nodiscard]] std::optional<RefinementMemory> refinementMemoryFrom(
    const SessionMetadata& metadata, std::span<const OperationLog::Entry> operations);

}  // namespace scantrove
