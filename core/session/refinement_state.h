#pragma once
#include "core/session/saved_scan.h"

namespace scantrove {

/// The key that tells how far the scan's refinement has come, and what it tells.
inline constexpr const char *kRefinementKey = "refinement", *kRefinementDone = "done",
                            *kRefinementPending = "pending";

/// Whether the session's scan can be refined still: that was skipped, or the scan broke off.
[[nodiscard]] bool canBeRefined(const SessionMetadata& metadata);

}  // namespace scantrove
