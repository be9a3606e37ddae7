#include "core/catalogue/object_database.h"

#include <QDateTime>

#include "core/catalogue/catalogue_schema.h"
#include "core/catalogue/object_name.h"
#include "core/catalogue/object_rows.h"
#include "core/catalogue/view_rows.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"

namespace scantrove {
namespace {

constexpr const char* kSelectObjects =
    "SELECT o.id, o.name, o.confirmed, o.size_x_m, o.size_y_m, o.size_z_m,"
    " (SELECT count(*) FROM views v WHERE v.object = o.id), o.first_session, s.source, o.created,"
    " o.named_by_person"
    " FROM objects o LEFT JOIN sessions s ON s.id = o.first_session WHERE o.hidden = 0 ";

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
  record.named_by = query.value(10).toInt() != 0 ? NamedBy::person : NamedBy::program;
  return record;
}

/// Versions of the schema: the oldest with all columns that are read, the first whose sessions have cameras,
/// and the first with an identity.
constexpr int kOldestToRead = 3, kFirstWithCameras = 4, kFirstWithIdentity = 6;
/// Between the beginnings of a session and of its part in the catalogue kernels may be compiled.
constexpr qint64 kBetweenBeginnings_s = 600;

/// The N of the next Obj_N: above all that were given, and not the name of any object, visible or not.
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

}  // namespace

Result<std::unique_ptr<ObjectDatabase>> ObjectDatabase::open(const std::string& database) {
  Result<std::unique_ptr<DatabaseConnection>> connection = DatabaseConnection::open(database);
  if (!connection) return fail(connection.error());
  SCANTROVE_TRY(schema::migrate(**connection, schema::kCatalogue, schema::catalogueSteps()));
  std::unique_ptr<ObjectDatabase> result(new ObjectDatabase);
  result->connection_ = std::move(*connection);
  return result;
}

Result<std::unique_ptr<ObjectDatabase>> ObjectDatabase::openToRead(const std::string& database) {
  Result<std::unique_ptr<DatabaseConnection>> connection = DatabaseConnection::openToRead(database);
  if (!connection) return fail(connection.error());
  const auto version =
      schema::versionToRead(**connection, schema::kCatalogue, schema::catalogueSteps(), kOldestToRead);
  if (!version) return fail(version.error());
  std::unique_ptr<ObjectDatabase> result(new ObjectDatabase);
  result->connection_ = std::move(*connection);
  result->has_cameras_ = *version >= kFirstWithCameras;
  result->has_identity_ = *version >= kFirstWithIdentity;
  return result;
}

bool ObjectDatabase::isStill() const { return connection_->isStill(); }

ObjectDatabase::ObjectDatabase() = default;
ObjectDatabase::~ObjectDatabase() = default;

Result<std::string> ObjectDatabase::identity() {
  if (!has_identity_) return std::string();
  Result<QSqlQuery> row = connection_->execute("SELECT uuid FROM identity");
  if (!row) return fail(row.error());
  const std::string identity = row->next() ? row->value(0).toString().toStdString() : std::string();
  if (identity.empty()) return fail(damagedDatabase(connection_->file(), "it has lost its identity"));
  return identity;
}

Result<bool> ObjectDatabase::hasScanOf(const std::string& begun) {
  const QDateTime time = QDateTime::fromString(QString::fromStdString(begun), Qt::ISODateWithMs);
  if (!time.isValid()) return false;
  const auto text = [&](qint64 later_s) { return time.toUTC().addSecs(later_s).toString(Qt::ISODateWithMs); };
  Result<QSqlQuery> count =
      connection_->execute("SELECT count(*) FROM sessions WHERE started BETWEEN ? AND ?",
                           {text(-kBetweenBeginnings_s), text(kBetweenBeginnings_s)});
  if (!count) return fail(count.error());
  return count->next() && count->value(0).toInt() > 0;
}

Result<std::int64_t> ObjectDatabase::beginSession(const std::string& source,
                                                  const std::optional<Intrinsics>& camera) {
  return inTransaction(*connection_, [&]() -> Result<std::int64_t> {
    const QString name = QString::fromStdString(source);
    Result<std::int64_t> id = connection_->insert("INSERT INTO sessions (source, started) VALUES (?, ?)",
                                                  {name, DatabaseConnection::now()});
    if (!id) return id;
    if (camera) {
      SCANTROVE_TRY(
          connection_->execute("UPDATE sessions SET fx = ?, fy = ?, cx = ?, cy = ?, image_width = ?, "
                               "image_height = ? WHERE id = ?",
                               {camera->fx, camera->fy, camera->cx, camera->cy, camera->width, camera->height,
                                static_cast<qlonglong>(*id)}));
    }
    SCANTROVE_TRY(recordEvent(*connection_, event::kSessionBegin, {}, {}, {{"source", name}}, *id));
    return id;
  });
}

Result<void> ObjectDatabase::endSession(std::int64_t session) {
  return inTransaction(*connection_, [&]() -> Result<void> {
    const Result<QSqlQuery> done =
        connection_->execute("UPDATE sessions SET ended = ? WHERE id = ?",
                             {DatabaseConnection::now(), static_cast<qlonglong>(session)});
    if (!done) return fail(done.error());
    if (done->numRowsAffected() != 1) {
      return fail("The database " + connection_->file() + " holds no session " + std::to_string(session) +
                  ".");
    }
    return recordEvent(*connection_, event::kSessionEnd, {}, {}, {}, session);
  });
}

Result<std::map<std::int64_t, Intrinsics>> ObjectDatabase::cameras() {
  std::map<std::int64_t, Intrinsics> cameras;
  if (!has_cameras_) return cameras;
  Result<QSqlQuery> query = connection_->execute(
      "SELECT id, fx, fy, cx, cy, image_width, image_height FROM sessions WHERE fx IS NOT NULL");
  if (!query) return fail(query.error());
  while (query->next()) {
    const auto number = [&](int column) { return query->value(column).toFloat(); };
    cameras[query->value(0).toLongLong()] = {
        number(1), number(2), number(3), number(4), query->value(5).toInt(), query->value(6).toInt()};
  }
  return cameras;
}

Result<std::vector<ObjectRecord>> ObjectDatabase::objects() {
  Result<QSqlQuery> query = connection_->execute(QString(kSelectObjects) + "ORDER BY o.id");
  if (!query) return fail(query.error());
  std::vector<ObjectRecord> records;
  while (query->next()) records.push_back(toRecord(*query));
  return records;
}

Result<ObjectRecord> ObjectDatabase::object(ObjectId id) {
  const Result<ObjectRow> row = readVisibleRow(*connection_, id);
  if (!row) return fail(row.error());
  Result<QSqlQuery> query = connection_->execute(QString(kSelectObjects) + "AND o.id = ?", {id.value});
  if (!query) return fail(query.error());
  if (!query->next())
    return fail(readVisibleRow(*connection_, id).error());  // hidden by another process just now
  return toRecord(*query);
}

Result<ObjectId> ObjectDatabase::findByName(const std::string& name) {
  return visibleObjectNamed(*connection_, QString::fromStdString(name));
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
    SCANTROVE_TRY(recordEvent(*connection_, event::kAdd, id, {}, {{"name", name}}, first_view.session));
    ObjectView view = first_view;
    view.object = id;
    SCANTROVE_TRY(insertView(view));
    return object(id);  // here: once it is committed, nothing may fail any more
  });
}

Result<bool> ObjectDatabase::discardViews(ObjectId object, std::int64_t session,
                                          std::span<const int> frames) {
  return inTransaction(*connection_, [&]() -> Result<bool> {
    const Result<ObjectRow> root = mergeRootOf(*connection_, object);
    if (!root) return fail(root.error());
    if (root->hidden || root->confirmed || root->named_by == NamedBy::person) return false;
    QVariantList views;
    for (const int frame : frames) {
      Result<QSqlQuery> view = connection_->execute(
          "SELECT id FROM views WHERE object = ? AND first_object = ? AND session = ? AND frame_index = ?",
          {root->id.value, object.value, static_cast<qlonglong>(session), frame});
      if (!view) return fail(view.error());
      while (view->next()) views.push_back(view->value(0));
    }
    if (views.empty()) return false;
    Result<QSqlQuery> all =
        connection_->execute("SELECT count(*) FROM views WHERE object = ?", {root->id.value});
    if (!all) return fail(all.error());
    if (all->next() && all->value(0).toInt() == views.size()) {
      ObjectRow row = *root;
      row.hidden = true;
      SCANTROVE_TRY(changeRow(*connection_, event::kRemove, *root, row));
      return true;
    }
    const Result<int> number = nextNumber(*connection_);
    if (!number) return fail(number.error());
    const Result<std::int64_t> left = connection_->insert(
        "INSERT INTO objects (number, name, hidden, size_x_m, size_y_m, size_z_m, first_session, created)"
        " VALUES (?, ?, 1, 0, 0, 0, ?, ?)",
        {*number, QString("Obj_%1").arg(*number), orNull(session), DatabaseConnection::now()});
    if (!left) return fail(left.error());
    const ObjectId discarded{static_cast<std::uint32_t>(*left)};
    for (const QVariant& view : views) {
      SCANTROVE_TRY(connection_->execute("UPDATE views SET object = ?, first_object = ? WHERE id = ?",
                                         {discarded.value, discarded.value, view}));
      SCANTROVE_TRY(connection_->execute("UPDATE view_summaries SET first_object = ? WHERE view = ?",
                                         {discarded.value, view}));
    }
    SCANTROVE_TRY(refreshObject(*connection_, discarded));
    SCANTROVE_TRY(refreshObject(*connection_, root->id));
    SCANTROVE_TRY(recordEvent(*connection_, event::kDiscardViews, root->id, {},
                              {{"left_behind", static_cast<qint64>(discarded.value)}}, session));
    return false;
  });
}

Result<void> ObjectDatabase::rename(ObjectId id, const std::string& name, NamedBy by) {
  const Result<QString> requested = checkedObjectName(name);
  if (!requested) return fail(requested.error());
  return inTransaction(*connection_, [&]() -> Result<void> {
    const Result<ObjectRow> before = readVisibleRow(*connection_, id);
    if (!before) return fail(before.error());
    const Result<ObjectId> other = visibleObjectNamed(*connection_, *requested);
    if (!other) return fail(other.error());
    if (*other && *other != id) {
      return fail("Another object in " + connection_->file() + " is called " + requested->toStdString() + ".",
                  "Choose another name, or merge the two if they are one.");
    }
    ObjectRow row = *before;
    row.name = *requested;
    row.named_by = by;
    if (row.name == before->name && row.named_by == before->named_by) return {};
    return changeRow(*connection_, event::kRename, *before, row);
  });
}

Result<void> ObjectDatabase::setConfirmed(std::span<const ObjectId> objects, bool confirmed) {
  return inTransaction(*connection_, [&]() -> Result<void> {
    for (const ObjectId id : objects) {
      const Result<ObjectRow> before = readVisibleRow(*connection_, id);
      if (!before) return fail(before.error());
      SCANTROVE_TRY(markConfirmed(*connection_, *before, confirmed));
    }
    return {};
  });
}

}  // namespace scantrove
