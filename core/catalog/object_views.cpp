// The views of ObjectDatabase: images and poses in and out of the table `views`.
#include <QJsonArray>
#include <QStringList>

#include "core/base/check.h"
#include "core/catalog/database_connection.h"
#include "core/catalog/image_blob.h"
#include "core/catalog/object_database.h"
#include "core/catalog/object_rows.h"
#include "core/catalog/transaction.h"

namespace scantrove {
namespace {

constexpr const char* kSelectViews =
    "SELECT v.id, v.object, v.session, v.frame_index, v.pose, v.direction_x, v.direction_y, v.direction_z,"
    " v.color, v.mask, v.depth_mm FROM views v ";

QString toText(const Eigen::Isometry3d& T) {
  QStringList numbers;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) numbers << QString::number(T.matrix()(row, column), 'g', 17);
  }
  return numbers.join(' ');
}

Eigen::Isometry3d toPose(const QString& text) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const QStringList numbers = text.split(' ');
  if (numbers.size() != 12) return T;
  for (int i = 0; i < 12; ++i) T.matrix()(i / 4, i % 4) = numbers[i].toDouble();
  return T;
}

ObjectView toView(const QSqlQuery& query) {
  ObjectView view;
  view.id = query.value(0).toLongLong();
  view.object = ObjectId{query.value(1).toUInt()};
  view.session = query.value(2).toLongLong();
  view.frame_index = query.value(3).toInt();
  view.T_world_camera = toPose(query.value(4).toString());
  view.direction = {query.value(5).toFloat(), query.value(6).toFloat(), query.value(7).toFloat()};
  view.color = fromPng(query.value(8).toByteArray());
  view.mask = fromPng(query.value(9).toByteArray());
  view.depth_mm = fromPng(query.value(10).toByteArray());
  return view;
}

Result<std::vector<ObjectView>> toViews(Result<QSqlQuery> query) {
  if (!query) return fail(query.error());
  std::vector<ObjectView> views;
  while (query->next()) views.push_back(toView(*query));
  return views;
}

}  // namespace

Result<std::vector<ObjectView>> ObjectDatabase::views(ObjectId id) {
  return toViews(
      connection_->execute(QString(kSelectViews) + "WHERE v.object = ? ORDER BY v.id", {id.value}));
}

Result<std::vector<ObjectView>> ObjectDatabase::viewsAfter(std::int64_t after) {
  return toViews(connection_->execute(
      QString(kSelectViews) +
          "JOIN objects o ON o.id = v.object WHERE v.id > ? AND o.hidden = 0 ORDER BY v.id",
      {static_cast<qlonglong>(after)}));
}

Result<ObjectView> ObjectDatabase::representativeView(ObjectId id) {
  Result<QSqlQuery> query = connection_->execute(
      "SELECT id, session, frame_index, color FROM views WHERE object = ? ORDER BY id DESC LIMIT 1",
      {id.value});
  if (!query) return fail(query.error());
  ObjectView view;
  view.object = id;
  if (!query->next()) return view;
  view.id = query->value(0).toLongLong();
  view.session = query->value(1).toLongLong();
  view.frame_index = query->value(2).toInt();
  view.color = fromPng(query->value(3).toByteArray());
  return view;
}

Result<std::int64_t> ObjectDatabase::addView(const ObjectView& view) {
  return inTransaction(*connection_, [&] { return insertView(view); });
}

Result<std::int64_t> ObjectDatabase::insertView(const ObjectView& view) {
  SCANTROVE_CHECK(view.mask.empty() || view.color.empty() || view.mask.size() == view.color.size());
  const Result<ObjectRow> holder = holderOf(*connection_, view.object);
  if (!holder) return fail(holder.error());
  const Result<std::int64_t> id = connection_->insert(
      "INSERT INTO views (object, first_object, session, frame_index, pose, direction_x, direction_y, "
      "direction_z,"
      " created, color, mask, depth_mm) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
      {holder->id.value, view.object.value, orNull(view.session), view.frame_index,
       toText(view.T_world_camera), view.direction.x(), view.direction.y(), view.direction.z(),
       DatabaseConnection::now(), toPng(view.color), toPng(view.mask), toPng(view.depth_mm)});
  if (!id) return id;
  SCANTROVE_TRY(recordEvent(*connection_, "add-view", holder->id, {}, {{"view", static_cast<qint64>(*id)}},
                            view.session));
  return id;
}

}  // namespace scantrove
