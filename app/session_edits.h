#pragma once
#include "app/session_arguments.h"

namespace scantrove {

// Edits of `scantrove session`, which change the session and its catalogue. Each prints the current numbers
// of the changed regions.

/// Prints the current numbers of the regions that an operation changed. Error: that of the outcome.
[[nodiscard]] Result<void> reportEdit(const Result<RegionEditor::Outcome>& outcome,
                                      const SessionArguments& arguments);

/// Performs the operation in the session and its catalogue.
[[nodiscard]] Result<void> performEdit(OpenSession& session, const SessionArguments& arguments,
                                       const Operation& operation);
/// Any operation but a cut and a paint.
[[nodiscard]] Result<void> editSession(OpenSession& session, const SessionArguments& arguments,
                                       OperationKind kind);
/// Marks all regions that are proposed as background, in one operation. Without any it says so.
[[nodiscard]] Result<void> markProposedBackground(OpenSession& session, const SessionArguments& arguments);
[[nodiscard]] Result<void> cutRegion(OpenSession& session, const SessionArguments& arguments);
/// Undoes all steps or none.
[[nodiscard]] Result<void> undoEdits(OpenSession& session, const SessionArguments& arguments);
[[nodiscard]] Result<void> redoEdits(OpenSession& session, const SessionArguments& arguments);

/// Applies the newest edit to the catalogue. A failure is only a warning, because the session holds the edit.
void updateCatalogue(OpenSession& session, const SessionArguments& arguments);

}  // namespace scantrove
