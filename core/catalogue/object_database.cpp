#include "core/catalogue/object_database.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "core/base/label_name.h"
#include "core/catalogue/catalogue_schema.h"
#include "core/catalogue/class_json.h"
#include "core/catalogue/event_rows.h"
#include "core/catalogue/object_rows.h"
#include "core/catalogue/view_rows.h"
#include "core/database/database_connection.h"

namespace scantrove {
namespace {

constexpr const char* kSelectObjects =
    "SELECT o.id, o.name, o.confirmed, o.size_x_m, o.size_y_m, o.size_z_m,"
    " (SELECT count(*) FROM views v WHERE v.object = o.id), o.first_session, s.source, o.created,"
    " o.named_by_person, %1"
    " FROM objects o LEFT JOIN sessions s ON s.id = o.first_session WHERE o.hidden = 0 ";

QString selectObjects(bool has_classes) {
  return QString(kSelectObjects).arg(has_classes ? "o.class, o.attributes" : "NULL, NULL");
}

ObjectRecord toRecord(const QSqlQuery& query) {
  ObjectRecord record;
  record.id = ObjectId{query.value(0).toUInt()};
  record.name = query.value(1).toString().toStdString();
  record.confirmed = query.value(2).toInt() != 0;
  record.size_m = {query.value(3).toFloat(), query.value(4).toFloat(), query.value(5).toFloat()};
  record.views = query.value(6).toInt();
  record.first_session = query.value(7).toLongLong();
  record.first_session_name = query.value(8).toString().toStdString();
  record.created = query.value(9).toString().toStdString();
  record.named_by = query.value(10).toInt() != 0 ? NamedBy::user : NamedBy::program;
  record.classification = {ClassId{query.value(11).toUInt()},
                           answersFromText(query.value(12).toString().toStdString())};
  return record;
}

/// Schema versions: the oldest with all columns that must be there, the first with cameras of sessions, the
/// first with an identity, and the first with classes.
constexpr int kOldestToRead = 3, kFirstWithCameras = 4, kFirstWithIdentity = 6, kFirstWithClasses = 9;

/// The N of the next Obj_N: above all earlier numbers, and not the name of any object, visible or not.
Result<int> nextNumber(DatabaseConnection& connection) {
  Result<QSqlQuery> last = connection.execute("SELECT max(number) FROM objects");
  if (!last) return fail(last.error());
  int number = last->next() ? last->value(0).toInt() : 0;
  for (;;) {
    ++number;
    Result<QSqlQuery> taken =
        connection.execute("SELECT count(*) FROM objects WHERE name = ?", {QString("Obj_%1").arg(number)});
    if (!taken) return fail(taken.error());
    if (!taken->next() || taken->value(0).toInt() == 0) return number;
  }
}

/// Adds a hidden object without views. Its number is below 0, so that the N of Obj_N counts only objects
/// that users have seen.
Result<ObjectId> addForDiscardedViews(DatabaseConnection& connection, std::int64_t session) {
  Result<QSqlQuery> lowest = connection.execute("SELECT min(number) FROM objects");
  if (!lowest) return fail(lowest.error());
  const qlonglong number = std::min<qlonglong>(0, lowest->next() ? lowest->value(0).toLongLong() : 0) - 1;
  const Result<std::int64_t> row = connection.insert(
      "INSERT INTO objects (number, name, hidden, size_x_m, size_y_m, size_z_m, first_session, created)"
      " VALUES (?, ?, 1, 0, 0, 0, ?, ?)",
      {number, "Discarded views", orNull(session), DatabaseConnection::now()});
  if (!row) return fail(row.error());
  return ObjectId{static_cast<std::uint32_t>(*row)};
}

/// Reads the rows for an unmerge.
Result<void> readMerge(ObjectRows& rows, const ObjectMerge& merge) {
  SCANTROVE_TRY(rows.read(merge.into));
  SCANTROVE_TRY(rows.read(merge.from));
  return rows.readNamesOf(merge.from);
}

/// Reads the rows for naming an object: its own, and that of an object which has the name.
Result<void> readForNaming(ObjectRows& rows, ObjectId object, const std::string& name) {
  SCANTROVE_TRY(rows.read(object));
  return rows.readNamed(name);
}

}  // namespace

Result<std::unique_ptr<ObjectDatabase>> ObjectDatabase::open(const std::string& database) {
  Result<std::unique_ptr<DatabaseConnection>> connection = DatabaseConnection::open(database);
  if (!connection) return fail(connection.error());
  SCANTROVE_TRY(schema::migrate(**connection, schema::kCatalogue, schema::catalogueSteps()));
  const int newest = static_cast<int>(schema::catalogueSteps().size());
  return std::unique_ptr<ObjectDatabase>(new ObjectDatabase(std::move(*connection), newest));
}

Result<std::unique_ptr<ObjectDatabase>> ObjectDatabase::openToRead(const std::string& database) {
  Result<std::unique_ptr<DatabaseConnection>> connection = DatabaseConnection::openToRead(database);
  if (!connection) return fail(connection.error());
  const auto version =
      schema::versionToRead(**connection, schema::kCatalogue, schema::catalogueSteps(), kOldestToRead);
  if (!version) return fail(version.error());
  return std::unique_ptr<ObjectDatabase>(new ObjectDatabase(std::move(*connection), *version));
}

ObjectDatabase::ObjectDatabase(std::unique_ptr<DatabaseConnection> connection, int version)
    : connection_(std::move(connection)),
      sessions_(*connection_, version >= kFirstWithCameras),
      views_(*connection_),
      classes_(*connection_),
      differences_(*connection_),
      has_identity_(version >= kFirstWithIdentity),
      has_classes_(version >= kFirstWithClasses) {}

ObjectDatabase::~ObjectDatabase() = default;

bool ObjectDatabase::isOnServer() const { return connection_->isOnServer(); }

bool ObjectDatabase::isStill() const { return connection_->isStill(); }

Result<std::string> ObjectDatabase::identity() {
  if (!has_identity_) return std::string();
  Result<QSqlQuery> row = connection_->execute("SELECT uuid FROM identity");
  if (!row) return fail(row.error());
  const std::string identity = row->next() ? row->value(0).toString().toStdString() : std::string();
  if (identity.empty()) return fail(damagedDatabase(connection_->file(), "it has lost its identity"));
  return identity;
}

Result<std::vector<ObjectRecord>> ObjectDatabase::objects() {
  Result<QSqlQuery> query = connection_->execute(selectObjects(has_classes_) + "ORDER BY o.id");
  if (!query) return fail(query.error());
  std::vector<ObjectRecord> records;
  while (query->next()) records.push_back(toRecord(*query));
  return records;
}

Result<ObjectRecord> ObjectDatabase::object(ObjectId id) {
  Result<QSqlQuery> query = connection_->execute(selectObjects(has_classes_) + "AND o.id = ?", {id.value});
  if (!query) return fail(query.error());
  if (query->next()) return toRecord(*query);
  ObjectRows rows(*connection_, has_classes_);
  SCANTROVE_TRY(rows.read(id));
  if (const Result<ObjectState> row = rows.model().shown(id); !row) return fail(row.error());
  return fail("The object " + std::to_string(id.value) + " in " + connection_->file() +
                  " was changed while it was read.",
              "Read it again.");
}

Result<ObjectId> ObjectDatabase::findByName(const std::string& name) {
  ObjectRows rows(*connection_, has_classes_);
  SCANTROVE_TRY(rows.readNamed(name));
  const ObjectState* object = rows.model().named(name);
  return object != nullptr ? object->id : ObjectId{};
}

Result<ObjectId> ObjectDatabase::mergeRoot(ObjectId id) {
  ObjectRows rows(*connection_, has_classes_);
  SCANTROVE_TRY(rows.read(id));
  if (const Result<ObjectState> object = rows.model().known(id); !object) return fail(object.error());
  return rows.model().mergeRoot(id);
}

Result<CatalogueModel> ObjectDatabase::model() {
  ObjectRows rows(*connection_, has_classes_);
  SCANTROVE_TRY(rows.readAll());
  return std::move(rows.model());
}

Result<std::int64_t> ObjectDatabase::lastEvent() { return scantrove::lastEvent(*connection_); }

Result<CatalogueChanges> ObjectDatabase::changesAfter(std::int64_t event) {
  return scantrove::changesAfter(*connection_, event);
}

Result<ObjectRecord> ObjectDatabase::addObject(const ObjectView& first_view) {
  return inTransaction(*connection_, [&]() -> Result<ObjectRecord> {
    const Result<int> number = nextNumber(*connection_);
    if (!number) return fail(number.error());
    const QString name = QString("Obj_%1").arg(*number);
    const Result<std::int64_t> row = connection_->insert(
        "INSERT INTO objects (number, name, size_x_m, size_y_m, size_z_m, first_session, created)"
        " VALUES (?, ?, ?, ?, ?, ?, ?)",
        {*number, name, first_view.size_m.x(), first_view.size_m.y(), first_view.size_m.z(),
         orNull(first_view.session), DatabaseConnection::now()});
    if (!row) return fail(row.error());
    const ObjectId id{static_cast<std::uint32_t>(*row)};
    SCANTROVE_TRY(recordEvent(*connection_, action::kAdd, id, {}, {{"name", name}}, first_view.session));
    ObjectView view = first_view;
    view.object = id;
    SCANTROVE_TRY(views_.insert(view));
    return object(id);  // read before the commit, because nothing may fail after it
  });
}

Result<std::int64_t> ObjectDatabase::addView(const ObjectView& view, const Check& check) {
  return inTransaction(*connection_, [&]() -> Result<std::int64_t> {
    SCANTROVE_TRY(check());
    return views_.insert(view);
  });
}

Result<bool> ObjectDatabase::discardViews(ObjectId object, std::int64_t session,
                                          std::span<const int> frames) {
  return inTransaction(*connection_, [&]() -> Result<bool> {
    ObjectRows rows(*connection_, has_classes_);
    SCANTROVE_TRY(rows.read(object));
    if (const Result<ObjectState> known = rows.model().known(object); !known) return fail(known.error());
    const ObjectId root = rows.model().mergeRoot(object);
    if (!rows.model().mayDiscardViews(root)) return false;
    QVariantList views;
    for (const int frame : frames) {
      Result<QSqlQuery> view = connection_->execute(
          "SELECT id FROM views WHERE object = ? AND first_object = ? AND session = ? AND frame_index = ?"
          " ORDER BY id",
          {root.value, object.value, static_cast<qlonglong>(session), frame});
      if (!view) return fail(view.error());
      while (view->next()) {
        if (views.contains(view->value(0))) continue;
        views.push_back(view->value(0));
        break;
      }
    }
    if (views.empty()) return false;
    Result<QSqlQuery> all = connection_->execute("SELECT count(*) FROM views WHERE object = ?", {root.value});
    if (!all) return fail(all.error());
    if (all->next() && all->value(0).toInt() == views.size()) {
      SCANTROVE_TRY(rows.model().remove({&root, 1}));
      SCANTROVE_TRY(rows.store());
      return true;
    }
    ObjectId discarded;
    SCANTROVE_TRY(moveInto(discarded, addForDiscardedViews(*connection_, session)));
    for (const QVariant& view : views) {
      SCANTROVE_TRY(connection_->execute("UPDATE views SET object = ?, first_object = ? WHERE id = ?",
                                         {discarded.value, discarded.value, view}));
      SCANTROVE_TRY(connection_->execute("UPDATE view_summaries SET first_object = ? WHERE view = ?",
                                         {discarded.value, view}));
    }
    SCANTROVE_TRY(refreshObject(*connection_, discarded));
    SCANTROVE_TRY(refreshObject(*connection_, root));
    SCANTROVE_TRY(recordEvent(*connection_, action::kDiscardViews, root, {},
                              {{"left_behind", static_cast<qint64>(discarded.value)}}, session));
    return false;
  });
}

Result<void> ObjectDatabase::rename(ObjectId id, const std::string& name, NamedBy by) {
  const Result<std::string> checked = checkedLabelName(name);
  if (!checked) return fail(checked.error());
  return changeCatalogue(
      *connection_, [&](ObjectRows& rows) { return readForNaming(rows, id, *checked); },
      [&](CatalogueModel& model) { return model.rename(id, *checked, by); });
}

Result<void> ObjectDatabase::setConfirmed(std::span<const ObjectId> objects, bool confirmed) {
  return changeCatalogue(
      *connection_, [&](ObjectRows& rows) { return rows.read(objects); },
      [&](CatalogueModel& model) { return model.setConfirmed(objects, confirmed); });
}

Result<ObjectNaming> ObjectDatabase::nameByUser(ObjectId id, const std::string& name,
                                                const std::string& class_name) {
  const Result<std::string> checked = checkedLabelName(name);
  if (!checked) return fail(checked.error());
  return changeCatalogue(
      *connection_, [&](ObjectRows& rows) { return readForNaming(rows, id, *checked); },
      [&](CatalogueModel& model) { return model.nameByUser(id, *checked, class_name); });
}

Result<bool> ObjectDatabase::revertNaming(const ObjectNaming& naming) {
  return changeCatalogue(
      *connection_,
      [&](ObjectRows& rows) -> Result<void> {
        if (naming.merge) SCANTROVE_TRY(readMerge(rows, *naming.merge));
        if (naming.made_class) SCANTROVE_TRY(rows.readOfClass(naming.made_class));
        return readForNaming(rows, naming.object, naming.earlier_name);
      },
      [&](CatalogueModel& model) { return model.revertNaming(naming); });
}

Result<ObjectMerge> ObjectDatabase::merge(std::span<const ObjectId> objects, const Check& check) {
  return changeCatalogue(
      *connection_,
      [&](ObjectRows& rows) -> Result<void> {
        SCANTROVE_TRY(check());
        return rows.read(objects);
      },
      [&](CatalogueModel& model) { return model.merge(objects); });
}

Result<void> ObjectDatabase::unmerge(const ObjectMerge& merge) {
  return changeCatalogue(
      *connection_, [&](ObjectRows& rows) { return readMerge(rows, merge); },
      [&](CatalogueModel& model) { return model.unmerge(merge); });
}

Result<bool> ObjectDatabase::revertMerge(const ObjectMerge& merge) {
  return changeCatalogue(
      *connection_, [&](ObjectRows& rows) { return readMerge(rows, merge); },
      [&](CatalogueModel& model) -> Result<bool> {
        const bool are_merged = std::ranges::all_of(merge.from, [&](ObjectId id) {
          const ObjectState* part = model.find(id);
          return part != nullptr && part->hidden && part->merged_into == merge.into;
        });
        if (!are_merged || !model.mergeRoot(merge.into)) return false;
        return model.unmerge(merge).map([] { return true; });
      });
}

Result<void> ObjectDatabase::remove(std::span<const ObjectId> objects) {
  return changeCatalogue(
      *connection_, [&](ObjectRows& rows) { return rows.read(objects); },
      [&](CatalogueModel& model) { return model.remove(objects); });
}

Result<void> ObjectDatabase::restore(std::span<const ObjectId> objects) {
  return changeCatalogue(
      *connection_,
      [&](ObjectRows& rows) -> Result<void> {
        SCANTROVE_TRY(rows.read(objects));
        return rows.readNamesOf(objects);
      },
      [&](CatalogueModel& model) { return model.restore(objects); });
}

Result<bool> ObjectDatabase::withdraw(ObjectId made) {
  return changeCatalogue(
      *connection_,
      [&](ObjectRows& rows) -> Result<void> {
        SCANTROVE_TRY(rows.read(made));
        return rows.readParts(made);
      },
      [&](CatalogueModel& model) { return model.withdraw(made); });
}

Result<std::string> ObjectDatabase::applyOnce(const std::string& token,
                                              const std::function<Result<std::string>()>& edit) {
  const QString key = QString::fromStdString(token);
  return inTransaction(*connection_, [&]() -> Result<std::string> {
    Result<QSqlQuery> earlier =
        connection_->execute("SELECT result FROM applied_edits WHERE token = ?", {key});
    if (!earlier) return fail(earlier.error());
    if (earlier->next()) return earlier->value(0).toString().toStdString();
    Result<std::string> result = edit();
    if (!result) return result;
    SCANTROVE_TRY(connection_->execute("INSERT INTO applied_edits (token, result, applied) VALUES (?, ?, ?)",
                                       {key, QString::fromStdString(*result), DatabaseConnection::now()}));
    return result;
  });
}

}  // namespace scantrove
