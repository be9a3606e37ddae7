// The operations of ObjectDatabase that hide objects and bring them back. Nothing is ever deleted.
#include <QJsonArray>

#include "core/catalog/database_connection.h"
#include "core/catalog/object_database.h"
#include "core/catalog/object_rows.h"
#include "core/catalog/transaction.h"

namespace scantrove {
namespace {

/// Views that were first seen as `id` or as an object merged into it, directly or not.
constexpr const char* kOwnViews =
    "WITH RECURSIVE family (id) AS (SELECT id FROM objects WHERE id = ?"
    " UNION SELECT o.id FROM objects o JOIN family f ON o.merged_into = f.id)"
    " SELECT v.id FROM views v JOIN family f ON v.first_object = f.id ORDER BY v.id";

Result<QJsonArray> giveViews(DatabaseConnection& connection, ObjectId of, ObjectId to) {
  Result<QSqlQuery> query = connection.execute(kOwnViews, {of.value});
  if (!query) return fail(query.error());
  QVariantList ids;
  while (query->next()) ids.push_back(query->value(0));
  QJsonArray moved;
  for (const QVariant& id : ids) {
    const Result<QSqlQuery> done =
        connection.execute("UPDATE views SET object = ? WHERE id = ?", {to.value, id});
    if (!done) return fail(done.error());
    moved.push_back(id.toLongLong());
  }
  return moved;
}

/// Makes a hidden row visible again; when its name was given away meanwhile it becomes "name (2)", "name
/// (3)", ...
Result<void> show(DatabaseConnection& connection, ObjectRow& row) {
  const QString wanted = row.name;
  for (int copy = 2;; ++copy) {
    const Result<ObjectId> other = visibleObjectNamed(connection, row.name);
    if (!other) return fail(other.error());
    if (!*other) break;
    row.name = QString("%1 (%2)").arg(wanted).arg(copy);
  }
  row.hidden = false;
  row.merged_into = {};
  return writeRow(connection, row);
}

}  // namespace

Result<void> ObjectDatabase::merge(ObjectId into, ObjectId from) {
  if (into == from) return fail("An object cannot be merged into itself.", "Choose two objects.");
  return inTransaction(*connection_, [&]() -> Result<void> {
    const Result<ObjectRow> target = readVisibleRow(*connection_, into);
    if (!target) return fail(target.error());
    Result<ObjectRow> row = readVisibleRow(*connection_, from);
    if (!row) return fail(row.error());
    const QJsonObject before = row->toJson();
    const Result<QJsonArray> moved = giveViews(*connection_, from, into);
    if (!moved) return fail(moved.error());
    row->hidden = true;
    row->merged_into = into;
    SCANTROVE_TRY(writeRow(*connection_, *row));
    QJsonObject after = row->toJson();
    after.insert("views", *moved);
    return recordEvent(*connection_, "merge", from, before, after);
  });
}

Result<void> ObjectDatabase::unmerge(ObjectId into, ObjectId from) {
  return inTransaction(*connection_, [&]() -> Result<void> {
    Result<ObjectRow> row = readRow(*connection_, from);
    if (!row) return fail(row.error());
    if (!row->hidden || row->merged_into != into) {
      return fail("The object " + std::to_string(from.value) + " (" + row->name.toStdString() + ") in " +
                      connection_->file() + " is not merged into object " + std::to_string(into.value) + ".",
                  "There is nothing to undo.");
    }
    const QJsonObject before = row->toJson();
    const Result<QJsonArray> moved = giveViews(*connection_, from, from);
    if (!moved) return fail(moved.error());
    SCANTROVE_TRY(show(*connection_, *row));
    QJsonObject after = row->toJson();
    after.insert("views", *moved);
    return recordEvent(*connection_, "unmerge", from, before, after);
  });
}

Result<void> ObjectDatabase::remove(ObjectId id) {
  return inTransaction(*connection_, [&]() -> Result<void> {
    Result<ObjectRow> row = readVisibleRow(*connection_, id);
    if (!row) return fail(row.error());
    const QJsonObject before = row->toJson();
    row->hidden = true;
    SCANTROVE_TRY(writeRow(*connection_, *row));
    return recordEvent(*connection_, "remove", id, before, row->toJson());
  });
}

Result<void> ObjectDatabase::restore(ObjectId id) {
  return inTransaction(*connection_, [&]() -> Result<void> {
    Result<ObjectRow> row = readRow(*connection_, id);
    if (!row) return fail(row.error());
    if (!row->hidden) return {};
    if (row->merged_into) return fail(readVisibleRow(*connection_, id).error());
    const QJsonObject before = row->toJson();
    SCANTROVE_TRY(show(*connection_, *row));
    return recordEvent(*connection_, "restore", id, before, row->toJson());
  });
}

}  // namespace scantrove
