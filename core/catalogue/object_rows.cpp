#include "core/catalogue/object_rows.h"

#include <set>

#include "core/catalogue/class_json.h"
#include "core/catalogue/event_rows.h"
#include "core/catalogue/view_rows.h"
#include "core/database/database_connection.h"

namespace scantrove {
namespace {

/// CROSS JOIN makes SQLite use the index instead of reading all images.
constexpr const char* kOwnViews =
    "WITH RECURSIVE family (id) AS (SELECT id FROM objects WHERE id = ?"
    " UNION SELECT o.id FROM objects o JOIN family f ON o.merged_into = f.id)"
    " SELECT v.id FROM family f CROSS JOIN views v WHERE v.first_object = f.id ORDER BY v.id";

}  // namespace

QVariant orNull(std::int64_t id) {
  return id == 0 ? QVariant(QMetaType(QMetaType::LongLong)) : QVariant(static_cast<qlonglong>(id));
}

ObjectRows::ObjectRows(DatabaseConnection& connection, bool has_classes)
    : connection_(connection), has_classes_(has_classes), model_(connection.file()) {}

Result<void> ObjectRows::select(const QString& condition, const QVariantList& values) {
  Result<QSqlQuery> query = connection_.execute(
      QString("SELECT id, name, named_by_person, confirmed, hidden, merged_into, %1 FROM objects")
              .arg(has_classes_ ? "class, attributes" : "NULL, NULL") +
          condition,
      values);
  if (!query) return fail(query.error());
  while (query->next()) {
    model_.put({ObjectId{query->value(0).toUInt()}, query->value(1).toString().toStdString(),
                query->value(2).toInt() != 0 ? NamedBy::user : NamedBy::program, query->value(3).toInt() != 0,
                query->value(4).toInt() != 0, ObjectId{query->value(5).toUInt()},
                Classification{ClassId{query->value(6).toUInt()},
                               answersFromText(query->value(7).toString().toStdString())}});
  }
  return {};
}

Result<void> ObjectRows::readClasses() {
  if (!has_classes_) return {};
  Result<QSqlQuery> query = connection_.execute(
      "SELECT id, name, color, supercategory, attributes, hidden, merged_into FROM classes");
  if (!query) return fail(query.error());
  while (query->next()) {
    const qlonglong id = query->value(0).toLongLong();
    if (id < 1 || id > kLargestClassId) continue;  // damaged: no class has such an id
    const ClassId class_id{static_cast<std::uint32_t>(id)};
    model_.putClass(
        {class_id, query->value(1).toString().toStdString(),
         colorFromHex(query->value(2).toString().toStdString()).value_or(defaultClassColor(class_id)),
         query->value(3).toString().toStdString(),
         attributesFromText(query->value(4).toString().toStdString()), query->value(5).toInt() != 0,
         ClassId{query->value(6).toUInt()}});
  }
  return {};
}

Result<void> ObjectRows::readAll() {
  SCANTROVE_TRY(readClasses());
  return select("", {});
}

Result<void> ObjectRows::readOfClass(ClassId root) {
  for (const ClassId id : model_.classes().familyOf(root))
    SCANTROVE_TRY(select(" WHERE class = ? AND hidden = 0", {id.value}));
  return {};
}

Result<void> ObjectRows::read(ObjectId id) {
  for (ObjectId next = id; next && model_.find(next) == nullptr;) {
    SCANTROVE_TRY(select(" WHERE id = ?", {next.value}));
    const ObjectState* object = model_.find(next);
    next = object != nullptr && object->hidden ? object->merged_into : ObjectId{};
  }
  return {};
}

Result<void> ObjectRows::read(std::span<const ObjectId> ids) {
  for (const ObjectId id : ids) SCANTROVE_TRY(read(id));
  return {};
}

Result<void> ObjectRows::readNamed(const std::string& name) {
  return select(" WHERE name = ? AND hidden = 0", {QString::fromStdString(name)});
}

Result<void> ObjectRows::readNamesOf(std::span<const ObjectId> ids) {
  for (const ObjectId id : ids) {
    const ObjectState* object = model_.find(id);
    if (object == nullptr) continue;
    const QString name = QString::fromStdString(object->name), copies = name + " (";
    SCANTROVE_TRY(
        select(" WHERE hidden = 0 AND (name = ? OR substr(name, 1, length(?)) = ?)", {name, copies, copies}));
  }
  return {};
}

Result<void> ObjectRows::readParts(ObjectId id) { return select(" WHERE merged_into = ?", {id.value}); }

Result<void> ObjectRows::moveViews(ObjectId object, ObjectId owner) {
  Result<QSqlQuery> query = connection_.execute(kOwnViews, {object.value});
  if (!query) return fail(query.error());
  QVariantList views;
  while (query->next()) views.push_back(query->value(0));
  for (const QVariant& view : views)
    SCANTROVE_TRY(connection_.execute("UPDATE views SET object = ? WHERE id = ?", {owner.value, view}));
  return {};
}

Result<void> ObjectRows::storeObject(const CatalogueChange& change) {
  const ObjectState& row = change.after;
  SCANTROVE_TRY(connection_.execute(
      "UPDATE objects SET name = ?, named_by_person = ?, confirmed = ?, hidden = ?, merged_into = ?"
      " WHERE id = ?",
      {QString::fromStdString(row.name), static_cast<int>(row.named_by == NamedBy::user),
       static_cast<int>(row.confirmed), static_cast<int>(row.hidden), orNull(row.merged_into.value),
       row.id.value}));
  if (change.before.classification == row.classification) return {};
  const std::string answers = answersToText(row.classification.attributes);
  SCANTROVE_TRY(connection_.execute(
      "UPDATE objects SET class = ?, attributes = ? WHERE id = ?",
      {orNull(row.classification.class_id.value),
       answers.empty() ? QVariant(QMetaType(QMetaType::QString)) : QVariant(QString::fromStdString(answers)),
       row.id.value}));
  return {};
}

Result<void> ObjectRows::storeClass(const ObjectClass& row) {
  SCANTROVE_TRY(connection_.execute(
      "INSERT INTO classes (id, name, color, supercategory, attributes, hidden, merged_into, created)"
      " VALUES (?, ?, ?, ?, ?, ?, ?, ?)"
      " ON CONFLICT (id) DO UPDATE SET name = excluded.name, color = excluded.color,"
      " supercategory = excluded.supercategory, attributes = excluded.attributes, hidden = excluded.hidden,"
      " merged_into = excluded.merged_into",
      {row.id.value, QString::fromStdString(row.name), QString::fromStdString(hexOf(row.color)),
       QString::fromStdString(row.supercategory), QString::fromStdString(attributesToText(row.attributes)),
       static_cast<int>(row.hidden), orNull(row.merged_into.value), DatabaseConnection::now()}));
  return {};
}

Result<void> ObjectRows::store() {
  using Kind = CatalogueChange::Kind;
  std::set<ObjectId> with_other_views;
  for (const CatalogueChange& change : model_.takeChanges()) {
    const ObjectState& row = change.after;
    if (change.kind == Kind::merged) SCANTROVE_TRY(moveViews(row.id, row.merged_into));
    if (change.kind == Kind::unmerged) SCANTROVE_TRY(moveViews(row.id, row.id));
    if (change.kind == Kind::merged || change.kind == Kind::unmerged)
      with_other_views.insert({row.id, change.mergeTarget()});
    if (change.of_class) {
      SCANTROVE_TRY(storeClass(change.of_class->after));
    } else if (change.kind == Kind::views_discarded) {
      with_other_views.insert(row.id);
    } else {
      SCANTROVE_TRY(storeObject(change));
    }
    SCANTROVE_TRY(recordChange(connection_, change));
  }
  for (const ObjectId object : with_other_views) SCANTROVE_TRY(refreshObject(connection_, object));
  return {};
}

}  // namespace scantrove
