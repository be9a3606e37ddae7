#pragma once
#include <QJsonObject>
#include <QString>
#include <QVariant>
#include <optional>

#include "core/base/ids.h"
#include "core/base/result.h"

namespace scantrove {

class DatabaseConnection;

/// What operations on objects need to see of one row.
struct ObjectRow {
  ObjectId id;
  QString name;
  bool confirmed = false;
  bool hidden = false;
  ObjectId merged_into;  ///< none: not merged

  [[nodiscard]] QJsonObject toJson() const;  ///< for the table `events`
};

/// For binding: null for 0.
[[nodiscard]] QVariant orNull(std::int64_t id);

/// The row, hidden or not. Error: no such object.
[[nodiscard]] Result<ObjectRow> readRow(DatabaseConnection& connection, ObjectId id);
/// The row of an object that people see. Error: also when it was deleted or merged (says into which).
[[nodiscard]] Result<ObjectRow> readVisibleRow(DatabaseConnection& connection, ObjectId id);
/// The visible object of that name, or none.
[[nodiscard]] Result<ObjectId> visibleObjectNamed(DatabaseConnection& connection, const QString& name);

/// Stores name, confirmed, hidden and merged_into.
[[nodiscard]] Result<void> writeRow(DatabaseConnection& connection, const ObjectRow& row);

/// One row of `events`; empty JSON objects are stored as null.
[[nodiscard]] Result<void> recordEvent(DatabaseConnection& connection, const char* action, ObjectId object,
                                       const QJsonObject& before, const QJsonObject& after,
                                       std::int64_t session = 0);

/// The object that holds what was once `id`'s: follows merges to their end. Hidden when that one was deleted.
[[nodiscard]] Result<ObjectRow> holderOf(DatabaseConnection& connection, ObjectId id);

}  // namespace scantrove
