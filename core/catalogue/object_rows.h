#pragma once
#include <QJsonObject>
#include <QString>
#include <QVariant>

#include "core/base/result.h"
#include "core/catalogue/object_record.h"

namespace scantrove {

class DatabaseConnection;

/// What operations on objects need to see of one row.
struct ObjectRow {
  ObjectId id;
  QString name;
  NamedBy named_by = NamedBy::program;
  bool confirmed = false;
  bool hidden = false;
  ObjectId merged_into;  ///< none: not merged

  [[nodiscard]] QJsonObject toJson() const;  ///< for the table `events`
};

/// What happened, in the table `events`.
namespace event {
inline constexpr const char* kSessionBegin = "session-begin";
inline constexpr const char* kSessionEnd = "session-end";
inline constexpr const char* kAdd = "add";
inline constexpr const char* kAddView = "add-view";
inline constexpr const char* kRename = "rename";
inline constexpr const char* kConfirm = "confirm";
inline constexpr const char* kUnconfirm = "unconfirm";
inline constexpr const char* kRemove = "remove";
inline constexpr const char* kRestore = "restore";
inline constexpr const char* kMerge = "merge";
inline constexpr const char* kUnmerge = "unmerge";
inline constexpr const char* kDiscardViews = "leave-behind";
}  // namespace event

/// For binding: null for 0.
[[nodiscard]] QVariant orNull(std::int64_t id);

/// The row, hidden or not. Error: no such object.
[[nodiscard]] Result<ObjectRow> readRow(DatabaseConnection& connection, ObjectId id);
/// The row of an object that people see. Error: also when it was deleted or merged (says into which).
[[nodiscard]] Result<ObjectRow> readVisibleRow(DatabaseConnection& connection, ObjectId id);
/// The visible object of that name, or none.
[[nodiscard]] Result<ObjectId> visibleObjectNamed(DatabaseConnection& connection, const QString& name);

/// Stores `row` in place of `before` and notes the event.
[[nodiscard]] Result<void> changeRow(DatabaseConnection& connection, const char* action,
                                     const ObjectRow& before, const ObjectRow& row);

/// Sets or takes the mark of an object; no event when it is so already.
[[nodiscard]] Result<void> markConfirmed(DatabaseConnection& connection, const ObjectRow& before,
                                         bool confirmed);

/// One row of `events`; empty JSON objects are stored as null.
[[nodiscard]] Result<void> recordEvent(DatabaseConnection& connection, const char* action, ObjectId object,
                                       const QJsonObject& before, const QJsonObject& after,
                                       std::int64_t session = 0);

/// The object that holds what was once `id`'s: follows merges to the first visible object, or to their end.
/// Hidden when that one was deleted, or (in a damaged file) when the merges go round in a circle or nowhere.
[[nodiscard]] Result<ObjectRow> mergeRootOf(DatabaseConnection& connection, ObjectId id);

}  // namespace scantrove
