#include "core/catalogue/object_rows.h"

#include <QJsonDocument>
#include <optional>
#include <set>

#include "core/database/database_connection.h"

namespace scantrove {
namespace {

QVariant textOrNull(const QJsonObject& object) {
  if (object.isEmpty()) return QVariant(QMetaType(QMetaType::QString));
  return QString::fromUtf8(QJsonDocument(object).toJson(QJsonDocument::Compact));
}

std::string nameForPeople(const ObjectRow& row) {
  return std::to_string(row.id.value) + " (" + row.name.toStdString() + ")";
}

Result<std::optional<ObjectRow>> findRow(DatabaseConnection& connection, ObjectId id) {
  Result<QSqlQuery> query = connection.execute(
      "SELECT name, named_by_person, confirmed, hidden, merged_into FROM objects WHERE id = ?", {id.value});
  if (!query) return fail(query.error());
  if (!query->next()) return std::nullopt;
  return ObjectRow{id,
                   query->value(0).toString(),
                   query->value(1).toInt() != 0 ? NamedBy::person : NamedBy::program,
                   query->value(2).toInt() != 0,
                   query->value(3).toInt() != 0,
                   ObjectId{query->value(4).toUInt()}};
}

}  // namespace

QVariant orNull(std::int64_t id) {
  return id == 0 ? QVariant(QMetaType(QMetaType::LongLong)) : QVariant(static_cast<qlonglong>(id));
}

QJsonObject ObjectRow::toJson() const {
  QJsonObject json{{"name", name},
                   {"named_by_person", named_by == NamedBy::person},
                   {"confirmed", confirmed},
                   {"hidden", hidden}};
  if (merged_into) json.insert("merged_into", static_cast<qint64>(merged_into.value));
  return json;
}

Result<ObjectRow> readRow(DatabaseConnection& connection, ObjectId id) {
  const Result<std::optional<ObjectRow>> row = findRow(connection, id);
  if (!row) return fail(row.error());
  if (!*row) {
    return fail("The database " + connection.file() + " holds no object " + std::to_string(id.value) + ".",
                "List its objects for the numbers there are.");
  }
  return **row;
}

Result<ObjectRow> readVisibleRow(DatabaseConnection& connection, ObjectId id) {
  Result<ObjectRow> row = readRow(connection, id);
  if (!row || !row->hidden) return row;
  if (row->merged_into) {
    return fail("The object " + nameForPeople(*row) + " in " + connection.file() +
                    " was merged into object " + std::to_string(row->merged_into.value) + ".",
                "Use that one, or undo the merge.");
  }
  return fail("The object " + nameForPeople(*row) + " in " + connection.file() + " was deleted.",
              "Restore it first.");
}

Result<ObjectId> visibleObjectNamed(DatabaseConnection& connection, const QString& name) {
  Result<QSqlQuery> query =
      connection.execute("SELECT id FROM objects WHERE name = ? AND hidden = 0", {name});
  if (!query) return fail(query.error());
  return query->next() ? ObjectId{query->value(0).toUInt()} : ObjectId{};
}

Result<void> changeRow(DatabaseConnection& connection, const char* action, const ObjectRow& before,
                       const ObjectRow& row) {
  SCANTROVE_TRY(connection.execute(
      "UPDATE objects SET name = ?, named_by_person = ?, confirmed = ?, hidden = ?, merged_into = ?"
      " WHERE id = ?",
      {row.name, static_cast<int>(row.named_by == NamedBy::person), static_cast<int>(row.confirmed),
       static_cast<int>(row.hidden), orNull(row.merged_into.value), row.id.value}));
  return recordEvent(connection, action, row.id, before.toJson(), row.toJson());
}

Result<void> markConfirmed(DatabaseConnection& connection, const ObjectRow& before, bool confirmed) {
  if (before.confirmed == confirmed) return {};
  ObjectRow row = before;
  row.confirmed = confirmed;
  return changeRow(connection, confirmed ? event::kConfirm : event::kUnconfirm, before, row);
}

Result<void> recordEvent(DatabaseConnection& connection, const char* action, ObjectId object,
                         const QJsonObject& before, const QJsonObject& after, std::int64_t session) {
  SCANTROVE_TRY(
      connection.execute("INSERT INTO events (created, action, object, session, before_json, after_json)"
                         " VALUES (?, ?, ?, ?, ?, ?)",
                         {DatabaseConnection::now(), QString(action), orNull(object.value), orNull(session),
                          textOrNull(before), textOrNull(after)}));
  return {};
}

Result<ObjectRow> mergeRootOf(DatabaseConnection& connection, ObjectId id) {
  Result<ObjectRow> row = readRow(connection, id);
  std::set<ObjectId> passed;
  while (row && row->hidden && row->merged_into && passed.insert(row->id).second) {
    const Result<std::optional<ObjectRow>> next = findRow(connection, row->merged_into);
    if (!next) return fail(next.error());
    if (!*next) break;
    row = **next;
  }
  return row;
}

}  // namespace scantrove
