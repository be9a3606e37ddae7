#pragma once
#include <filesystem>

#include "core/base/result.h"
#include "core/session/open_session.h"

namespace scantrove {

// What is said of the regions of an opened session, told to the catalogue that it was scanned with. The
// thread of the session.

/// The catalogue of the session: a file that may be missing; empty: it had none.
[[nodiscard]] std::filesystem::path catalogueFileOf(const OpenSession& session);

/// Whether an edit has something left to do in the catalogue.
[[nodiscard]] bool isCataloguePending(const OpenSession& session);

/// The catalogue does what operations of the session wait for (OpenSession::pendingEdits), each as a whole
/// and once, however often this is tried:
/// - A region that was named is an object of that name, confirmed: the one that it is already, made one with
/// another of
///   that name where there is such; else a new one, with views from the session's key frames.
/// - A naming that was undone is taken back, but for what others said of the object since; an object that was
/// made for
///   it is removed.
/// - A region that is said to be an object is one, named by the program where it is new; an undo takes that
/// back
///   likewise.
/// Error: the catalogue is not there (none is made), cannot be written, or the device failed: then the edit
/// waits until the next call or until the session is opened again. Or something cannot be done at all, such
/// as to name a region that no key frame shows: the rest is done.
[[nodiscard]] Result<void> applyToCatalogue(OpenSession& session);

}  // namespace scantrove
