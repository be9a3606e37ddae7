#pragma once
#include <QJsonObject>
#include <cstdint>

#include "core/base/result.h"
#include "core/catalogue/catalogue_change.h"

namespace scantrove {

class DatabaseConnection;

/// Events of the table `events` other than changes of objects and classes.
namespace action {
inline constexpr const char* kSessionBegin = "session-begin";
inline constexpr const char* kSessionEnd = "session-end";
inline constexpr const char* kAdd = "add";
inline constexpr const char* kAddView = "add-view";
inline constexpr const char* kDiscardViews = "leave-behind";
inline constexpr const char* kDifferent = "different";
inline constexpr const char* kDifferentUndone = "different-undone";
}  // namespace action

/// One row of `events`; empty JSON objects are stored as null.
[[nodiscard]] Result<void> recordEvent(DatabaseConnection& connection, const char* action, ObjectId object,
                                       const QJsonObject& before, const QJsonObject& after,
                                       std::int64_t session = 0);
/// Inserts a change that CatalogueModel decided.
[[nodiscard]] Result<void> recordChange(DatabaseConnection& connection, const CatalogueChange& change);

/// The newest row; 0: none.
[[nodiscard]] Result<std::int64_t> lastEvent(DatabaseConnection& connection);
/// The rows after that one. Rows that are malformed or no change of an object or a class are left out.
[[nodiscard]] Result<CatalogueChanges> changesAfter(DatabaseConnection& connection, std::int64_t event);

}  // namespace scantrove
