#pragma once
#include "core/session/saved_scan.h"

namespace scantrove {

/// Whether the session's scan can be refined still: that was skipped, or the scan broke off.
[[nodiscard]] bool canBeRefined(const SessionMetadata& metadata);

}  // namespace scantrove
