#include "core/catalogue/event_rows.h"

#include <QJsonDocument>
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/catalogue/object_rows.h"
#include "core/database/database_connection.h"

namespace scantrove {
namespace {

using Kind = CatalogueChange::Kind;

constexpr std::array<std::pair<Kind, const char*>, 10> kActions{
    {{Kind::added, action::kAdd},
     {Kind::view_added, action::kAddView},
     {Kind::renamed, "rename"},
     {Kind::confirmed, "confirm"},
     {Kind::unconfirmed, "unconfirm"},
     {Kind::removed, "remove"},
     {Kind::restored, "restore"},
     {Kind::merged, "merge"},
     {Kind::unmerged, "unmerge"},
     {Kind::views_discarded, action::kDiscardViews}}};

QVariant textOrNull(const QJsonObject& object) {
  if (object.isEmpty()) return QVariant(QMetaType(QMetaType::QString));
  return QString::fromUtf8(QJsonDocument(object).toJson(QJsonDocument::Compact));
}

QJsonObject toJson(const ObjectState& object) {
  QJsonObject json{{"name", QString::fromStdString(object.name)},
                   {"named_by_person", object.named_by == NamedBy::user},
                   {"confirmed", object.confirmed},
                   {"hidden", object.hidden}};
  if (object.merged_into) json.insert("merged_into", static_cast<qint64>(object.merged_into.value));
  return json;
}

QJsonObject readJson(const QVariant& text) { return QJsonDocument::fromJson(text.toByteArray()).object(); }

ObjectState stateFrom(ObjectId id, const QJsonObject& json) {
  return {id,
          json["name"].toString().toStdString(),
          json["named_by_person"].toBool() ? NamedBy::user : NamedBy::program,
          json["confirmed"].toBool(),
          json["hidden"].toBool(),
          ObjectId{static_cast<std::uint32_t>(json["merged_into"].toInteger())}};
}

std::optional<CatalogueChange> changeFrom(const QString& action, ObjectId object, const QJsonObject& before,
                                          const QJsonObject& after) {
  const auto kind = std::ranges::find_if(kActions, [&](const auto& known) { return action == known.second; });
  if (!object || kind == kActions.end()) return std::nullopt;
  const CatalogueChange change{kind->first, stateFrom(object, before), stateFrom(object, after),
                               after["view"].toInteger(),
                               ObjectId{static_cast<std::uint32_t>(after["unmerged"].toInteger())}};
  const bool is_merge = change.kind == Kind::merged || change.kind == Kind::unmerged;
  const bool makes_sense = (change.kind != Kind::view_added || after.contains("view")) &&
                           (change.kind != Kind::renamed || after.contains("name")) &&
                           (!is_merge || change.mergeTarget());
  return makes_sense ? std::optional(change) : std::nullopt;
}

}  // namespace

Result<void> recordEvent(DatabaseConnection& connection, const char* action, ObjectId object,
                         const QJsonObject& before, const QJsonObject& after, std::int64_t session) {
  SCANTROVE_TRY(
      connection.execute("INSERT INTO events (created, action, object, session, before_json, after_json)"
                         " VALUES (?, ?, ?, ?, ?, ?)",
                         {DatabaseConnection::now(), QString(action), orNull(object.value), orNull(session),
                          textOrNull(before), textOrNull(after)}));
  return {};
}

Result<void> recordChange(DatabaseConnection& connection, const CatalogueChange& change) {
  const char* action = std::ranges::find(kActions, change.kind, &std::pair<Kind, const char*>::first)->second;
  if (change.kind == Kind::views_discarded) {
    return recordEvent(connection, action, change.object(), {},
                       {{"unmerged", static_cast<qint64>(change.part.value)}});
  }
  return recordEvent(connection, action, change.object(), toJson(change.before), toJson(change.after));
}

Result<std::int64_t> lastEvent(DatabaseConnection& connection) {
  Result<QSqlQuery> query = connection.execute("SELECT max(id) FROM events");
  if (!query) return fail(query.error());
  return query->next() ? query->value(0).toLongLong() : 0;
}

Result<CatalogueChanges> changesAfter(DatabaseConnection& connection, std::int64_t event) {
  Result<QSqlQuery> query = connection.execute(
      "SELECT id, action, object, before_json, after_json FROM events WHERE id > ? ORDER BY id",
      {static_cast<qlonglong>(event)});
  if (!query) return fail(query.error());
  CatalogueChanges result;
  result.last_event = event;
  while (query->next()) {
    result.last_event = query->value(0).toLongLong();
    const std::optional<CatalogueChange> change =
        changeFrom(query->value(1).toString(), ObjectId{query->value(2).toUInt()}, readJson(query->value(3)),
                   readJson(query->value(4)));
    if (change) result.changes.push_back(*change);
  }
  return result;
}

}  // namespace scantrove
