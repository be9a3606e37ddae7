// The table `events` as a feed of changes.
#include <QJsonDocument>
#include <optional>

#include "core/catalogue/object_database.h"
#include "core/catalogue/object_rows.h"
#include "core/database/database_connection.h"

namespace scantrove {
namespace {

QJsonObject toJson(const QVariant& text) { return QJsonDocument::fromJson(text.toByteArray()).object(); }

ObjectId mergedInto(const QJsonObject& row) {
  return ObjectId{static_cast<std::uint32_t>(row["merged_into"].toInteger())};
}

/// Nothing for what is no change of an object (a session began) and for rows that make no sense.
std::optional<CatalogueChange> toChange(const QString& action, ObjectId object, const QJsonObject& before,
                                        const QJsonObject& after) {
  if (!object) return std::nullopt;
  if (action == event::kAdd) return change::Added{object};
  if (action == event::kConfirm) return change::Confirmed{object, true};
  if (action == event::kUnconfirm) return change::Confirmed{object, false};
  if (action == event::kRemove) return change::Removed{object};
  if (action == event::kRestore) return change::Restored{object};
  if (action == event::kDiscardViews) return change::ViewsDiscarded{object};
  if (action == event::kAddView && after.contains("view")) {
    return change::ViewAdded{object, after["view"].toInteger()};
  }
  if (action == event::kRename && after.contains("name")) {
    return change::Renamed{object, after["name"].toString().toStdString()};
  }
  if (action == event::kMerge && mergedInto(after)) return change::Merged{mergedInto(after), object};
  if (action == event::kUnmerge && mergedInto(before)) return change::Unmerged{mergedInto(before), object};
  return std::nullopt;
}

}  // namespace

Result<std::int64_t> ObjectDatabase::lastEvent() {
  Result<QSqlQuery> query = connection_->execute("SELECT max(id) FROM events");
  if (!query) return fail(query.error());
  return query->next() ? query->value(0).toLongLong() : 0;
}

Result<CatalogueChanges> ObjectDatabase::changesAfter(std::int64_t event) {
  Result<QSqlQuery> query = connection_->execute(
      "SELECT id, action, object, before_json, after_json FROM events WHERE id > ? ORDER BY id",
      {static_cast<qlonglong>(event)});
  if (!query) return fail(query.error());
  CatalogueChanges result;
  result.last_event = event;
  while (query->next()) {
    result.last_event = query->value(0).toLongLong();
    const std::optional<CatalogueChange> change =
        toChange(query->value(1).toString(), ObjectId{query->value(2).toUInt()}, toJson(query->value(3)),
                 toJson(query->value(4)));
    if (change) result.changes.push_back(*change);
  }
  return result;
}

}  // namespace scantrove
