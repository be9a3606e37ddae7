#pragma once
#include "app/session_arguments.h"

namespace scantrove {

// Output of `scantrove session`, as text or JSON.

/// Frames, map, regions, operations.
[[nodiscard]] Result<void> showSession(OpenSession& session, const SessionArguments& arguments);
[[nodiscard]] Result<void> listRegions(OpenSession& session, const SessionArguments& arguments);
/// The region at a pixel of a frame.
[[nodiscard]] Result<void> showAt(OpenSession& session, const SessionArguments& arguments);
[[nodiscard]] Result<void> listOperations(OpenSession& session, const SessionArguments& arguments);

}  // namespace scantrove
