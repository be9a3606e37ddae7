#pragma once
#include "app/session_arguments.h"

namespace scantrove {

/// Prints the operations that masks of another program suggest; with `apply`, performs each as one operation
/// of the session's history. Error: as of MaskFolder::open() and suggestEdits(); or an operation failed,
/// after the others were performed.
[[nodiscard]] Result<void> suggestFromMasks(OpenSession& session, const SessionArguments& arguments);

}  // namespace scantrove
