#pragma once
#include "app/session_arguments.h"

namespace scantrove {

// What `scantrove session` changes in a session, and with it in its catalogue. Each prints the regions that
// the operation was about, by their numbers now.

/// Any operation but a cut.
[[nodiscard]] Result<void> editSession(OpenSession& session, const SessionArguments& arguments,
                                       OperationKind kind);
[[nodiscard]] Result<void> cutRegion(OpenSession& session, const SessionArguments& arguments);
/// All steps are taken or none.
[[nodiscard]] Result<void> undoEdits(OpenSession& session, const SessionArguments& arguments);
[[nodiscard]] Result<void> redoEdits(OpenSession& session, const SessionArguments& arguments);

}  // namespace scantrove
