#pragma once
#include "core/session/saved_scan.h"

namespace scantrove {

/// The metadata key and values for the progress of the scan's refinement.
inline constexpr const char *kRefinementKey = "refinement", *kRefinementDone = "done",
                            *kRefinementPending = "pending";

/// Whether the session's scan can still be refined: refinement was skipped, or the scan was interrupted.
[[nodiscard]] bool canBeRefined(const SessionMetadata& metadata);

}  // namespace scantrove
