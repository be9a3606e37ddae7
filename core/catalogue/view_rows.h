#pragma once
#include <cstdint>

#include "core/base/ids.h"
#include "core/base/result.h"
#include "core/catalogue/view_summary.h"

namespace scantrove {

class DatabaseConnection;

/// Stores what was computed of `view` (uses its id, first object and size), inside the caller's
/// transaction.
[[nodiscard]] Result<void> insertSummary(DatabaseConnection& connection, const ObjectView& view,
                                         const ViewSummary& summary);

/// Reads one view's images and stores what is computed of them, replacing earlier values. A view with
/// unusable images is named in the log, and its summary has only an area of 0. Inside the caller's
/// transaction. Returns the object that has the view.
[[nodiscard]] Result<ObjectId> summarizeStoredView(DatabaseConnection& connection, std::int64_t view);

/// Reads one view's images and stores the histogram of their colours; no bytes if they are unusable. Inside
/// the caller's transaction.
[[nodiscard]] Result<void> storeColors(DatabaseConnection& connection, std::int64_t view);

/// Updates size and best view of an object from its current views.
[[nodiscard]] Result<void> refreshObject(DatabaseConnection& connection, ObjectId object);

/// Names a skipped view in the log.
void warnOfView(const DatabaseConnection& connection, std::int64_t view, ObjectId object,
                const std::string& flaw);

}  // namespace scantrove
