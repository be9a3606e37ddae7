#pragma once
#include <filesystem>

#include "core/base/result.h"
#include "core/session/open_session.h"

namespace scantrove {

// Applies labels of an opened session to the catalogue of its scan. The session's thread.

/// The session's catalogue: a file that may be missing; empty: it had none.
[[nodiscard]] std::filesystem::path catalogueFileOf(const OpenSession& session);

/// Whether an edit is still pending in the catalogue.
[[nodiscard]] bool isCataloguePending(const OpenSession& session);

/// Executes the pending catalogue edits of the session (OpenSession::pendingEdits), each atomically and
/// once, however often it is tried:
/// - A named region becomes a confirmed object of that name: its own, merged with another object of that
/// name if there is one, or a new one with views from the key frames.
/// - An undone naming is reverted, except for later changes by others; an object made for it is removed.
/// - A region marked as an object becomes one; the program names a new one. An undo reverts that likewise.
/// Error: the catalogue is missing (none is created) or not writable, or the device failed: the edit waits
/// until the next call or the next opening. Also if something is impossible, such as naming a region that
/// no key frame shows: the rest is done.
[[nodiscard]] Result<void> applyToCatalogue(OpenSession& session);

}  // namespace scantrove
