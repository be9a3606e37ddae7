#include "core/catalogue/event_rows.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/catalogue/class_json.h"
#include "core/catalogue/object_rows.h"
#include "core/database/database_connection.h"

namespace scantrove {
namespace {

using Kind = CatalogueChange::Kind;

constexpr std::array<std::pair<Kind, const char*>, 17> kActions{
    {{Kind::added, action::kAdd},
     {Kind::view_added, action::kAddView},
     {Kind::renamed, "rename"},
     {Kind::confirmed, "confirm"},
     {Kind::unconfirmed, "unconfirm"},
     {Kind::removed, "remove"},
     {Kind::restored, "restore"},
     {Kind::merged, "merge"},
     {Kind::unmerged, "unmerge"},
     {Kind::views_discarded, action::kDiscardViews},
     {Kind::classified, "classify"},
     {Kind::class_added, "class-add"},
     {Kind::class_edited, "class-edit"},
     {Kind::class_hidden, "class-hide"},
     {Kind::class_restored, "class-restore"},
     {Kind::class_merged, "class-merge"},
     {Kind::class_unmerged, "class-unmerge"}}};

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
  const Classification& own = object.classification;
  if (own.class_id) json.insert("class", static_cast<qint64>(own.class_id.value));
  QJsonObject answers;
  for (const auto& [name, value] : own.attributes)
    answers.insert(QString::fromStdString(name), QString::fromStdString(value));
  if (!answers.isEmpty()) json.insert("attributes", answers);
  return json;
}

/// Empty for a class that did not exist.
QJsonObject toJson(const ObjectClass& object_class) {
  if (!object_class.id) return {};
  const QByteArray attributes = QByteArray::fromStdString(attributesToText(object_class.attributes));
  QJsonObject json{{"class", static_cast<qint64>(object_class.id.value)},
                   {"name", QString::fromStdString(object_class.name)},
                   {"color", QString::fromStdString(hexOf(object_class.color))},
                   {"supercategory", QString::fromStdString(object_class.supercategory)},
                   {"attributes", QJsonDocument::fromJson(attributes).array()},
                   {"hidden", object_class.hidden}};
  if (object_class.merged_into)
    json.insert("merged_into", static_cast<qint64>(object_class.merged_into.value));
  return json;
}

/// None: malformed.
std::optional<ObjectClass> classFrom(const QJsonObject& json) {
  const qint64 id = json["class"].toInteger(), merged_into = json["merged_into"].toInteger();
  const std::optional<ClassColor> color = colorFromHex(json["color"].toString().toStdString());
  if (id < 1 || id > kLargestClassId || merged_into < 0 || merged_into > kLargestClassId || !color)
    return std::nullopt;
  const QByteArray attributes = QJsonDocument(json["attributes"].toArray()).toJson(QJsonDocument::Compact);
  return ObjectClass{ClassId{static_cast<std::uint32_t>(id)},
                     json["name"].toString().toStdString(),
                     *color,
                     json["supercategory"].toString().toStdString(),
                     attributesFromText(attributes.toStdString()),
                     json["hidden"].toBool(),
                     ClassId{static_cast<std::uint32_t>(merged_into)}};
}

QJsonObject readJson(const QVariant& text) { return QJsonDocument::fromJson(text.toByteArray()).object(); }

Classification classificationFrom(const QJsonObject& json) {
  Classification own;
  own.class_id = ClassId{static_cast<std::uint32_t>(json["class"].toInteger())};
  const QJsonObject answers = json["attributes"].toObject();
  for (auto answer = answers.begin(); answer != answers.end(); ++answer)
    own.attributes[answer.key().toStdString()] = answer.value().toString().toStdString();
  return own;
}

ObjectState stateFrom(ObjectId id, const QJsonObject& json) {
  return {id,
          json["name"].toString().toStdString(),
          json["named_by_person"].toBool() ? NamedBy::user : NamedBy::program,
          json["confirmed"].toBool(),
          json["hidden"].toBool(),
          ObjectId{static_cast<std::uint32_t>(json["merged_into"].toInteger())},
          classificationFrom(json)};
}

std::optional<CatalogueChange> classChangeFrom(Kind kind, const QJsonObject& before,
                                               const QJsonObject& after) {
  const std::optional<ObjectClass> now = classFrom(after);
  if (!now) return std::nullopt;
  CatalogueChange change;
  change.kind = kind;
  change.of_class = ClassChange{classFrom(before).value_or(ObjectClass{}), *now};
  return change;
}

std::optional<CatalogueChange> changeFrom(const QString& action, ObjectId object, const QJsonObject& before,
                                          const QJsonObject& after) {
  const auto kind = std::ranges::find_if(kActions, [&](const auto& known) { return action == known.second; });
  if (kind == kActions.end()) return std::nullopt;
  if (isOfClass(kind->first)) return classChangeFrom(kind->first, before, after);
  if (!object) return std::nullopt;
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
  connection.announceChange();
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
  if (change.of_class)
    return recordEvent(connection, action, {}, toJson(change.of_class->before),
                       toJson(change.of_class->after));
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
