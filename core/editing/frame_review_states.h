#pragma once
#include <map>

#include "core/editing/operation_log.h"

namespace scantrove {

/// States of key frames by SavedFrame::number, as of their newest review that is done. Frames without one
/// are missing: they are open.
[[nodiscard]] std::map<int, ReviewState> reviewStatesOf(const OperationLog& log);

/// The state of a key frame in such a map.
[[nodiscard]] ReviewState stateIn(const std::map<int, ReviewState>& states, int key_frame);

}  // namespace scantrove
