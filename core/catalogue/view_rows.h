#pragma once
#include <cstdint>

#include "core/base/ids.h"
#include "core/base/result.h"
#include "core/catalogue/view_summary.h"

namespace scantrove {

class DatabaseConnection;

/// Stores what was computed of `view` (its id, first object and size are read), inside the caller's
/// transaction.
[[nodiscard]] Result<void> insertSummary(DatabaseConnection& connection, const ObjectView& view,
                                         const ViewSummary& summary);

/// Reads one view's images and stores what is computed of them, in place of what there was; a view whose
/// images cannot be used is named in the log and has no summary but an area of 0. Inside the caller's
/// transaction. Returns the object that holds the view.
[[nodiscard]] Result<ObjectId> summarizeStoredView(DatabaseConnection& connection, std::int64_t view);

/// Brings size and best view of an object in line with the views that it holds now.
[[nodiscard]] Result<void> refreshObject(DatabaseConnection& connection, ObjectId object);

/// Names a view that is left out in the log.
void warnOfView(const DatabaseConnection& connection, std::int64_t view, ObjectId object,
                const std::string& flaw);

}  // namespace scantrove
