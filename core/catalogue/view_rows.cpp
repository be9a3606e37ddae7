#include "core/catalogue/view_rows.h"

#include <spdlog/spdlog.h>

#include <QVariant>

#include "core/catalogue/image_blob.h"
#include "core/catalogue/median_size.h"
#include "core/catalogue/object_rows.h"
#include "core/database/database_connection.h"

namespace scantrove {
namespace {

/// The bytes of an array of plain values.
template <class Values>
QByteArray toBlob(const Values& values) {
  return {reinterpret_cast<const char*>(values.data()),
          static_cast<qsizetype>(values.size() * sizeof(*values.data()))};
}

/// No bytes (not null) if there are none.
QByteArray colorsBlob(const std::optional<ViewColors>& colors) {
  return colors ? toBlob(colors->roots) : QByteArray("");
}

Result<void> storeImages(DatabaseConnection& connection, qlonglong view, const ViewSummary& summary) {
  if (summary.descriptor) {
    const ViewDescriptor& descriptor = *summary.descriptor;
    const Thumbnail& thumbnail = descriptor.thumbnail;
    SCANTROVE_TRY(
        connection.execute("INSERT INTO descriptors (view, mean_l, mean_a, mean_b, fine, colors)"
                           " VALUES (?, ?, ?, ?, ?, ?) ON CONFLICT (view) DO UPDATE SET"
                           " mean_l = excluded.mean_l, mean_a = excluded.mean_a, mean_b = excluded.mean_b,"
                           " fine = excluded.fine, colors = excluded.colors",
                           {view, thumbnail.mean_lab.x(), thumbnail.mean_lab.y(), thumbnail.mean_lab.z(),
                            toBlob(thumbnail.fine), colorsBlob(descriptor.colors)}));
    if (descriptor.network) {
      SCANTROVE_TRY(connection.execute(
          "INSERT INTO view_vectors (view, network, vector) VALUES (?, ?, ?)"
          " ON CONFLICT (view) DO UPDATE SET network = excluded.network, vector = excluded.vector",
          {view, QString::fromStdString(descriptor.network->network), toBlob(descriptor.network->values)}));
    }
  }
  if (!summary.picture_jpeg.isEmpty()) {
    SCANTROVE_TRY(
        connection.execute("INSERT INTO pictures (view, jpeg) VALUES (?, ?)"
                           " ON CONFLICT (view) DO UPDATE SET jpeg = excluded.jpeg",
                           {view, summary.picture_jpeg}));
  }
  return {};
}

}  // namespace

Result<void> insertSummary(DatabaseConnection& connection, const ObjectView& view,
                           const ViewSummary& summary) {
  const auto id = static_cast<qlonglong>(view.id);
  QVariantList values{id,
                      view.object.value,
                      summary.object_pixels,
                      view.size_m.x(),
                      view.size_m.y(),
                      view.size_m.z(),
                      orNull(view.session)};
  for (int i = 0; i < 3; ++i) {
    values << (view.centroid_world ? QVariant((*view.centroid_world)[i])
                                   : QVariant(QMetaType(QMetaType::Float)));
  }
  SCANTROVE_TRY(connection.execute(
      "INSERT INTO view_summaries (view, first_object, object_pixels, size_x_m, size_y_m, size_z_m, session,"
      " place_x_m, place_y_m, place_z_m) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
      values));
  return storeImages(connection, id, summary);
}

Result<ObjectId> summarizeStoredView(DatabaseConnection& connection, std::int64_t id) {
  const auto view_id = static_cast<qlonglong>(id);
  Result<QSqlQuery> query =
      connection.execute("SELECT object, color, mask FROM views WHERE id = ?", {view_id});
  if (!query) return fail(query.error());
  ObjectView view;
  ViewSummary summary;
  if (query->next()) {
    view.object = ObjectId{query->value(0).toUInt()};
    const QByteArray color = query->value(1).toByteArray(), mask = query->value(2).toByteArray();
    view.color = decodedImage(color);
    view.mask = decodedImage(mask);
    std::string flaw = flawOf(view);
    if (view.color.empty() && !color.isEmpty()) flaw = "its colour is not an image";
    if (view.mask.empty() && !mask.isEmpty()) flaw = "its mask is not an image";
    if (flaw.empty()) {
      summary = summarize(view);
    } else {
      warnOfView(connection, id, view.object, flaw);
    }
  }
  SCANTROVE_TRY(connection.execute("UPDATE view_summaries SET object_pixels = ? WHERE view = ?",
                                   {summary.object_pixels, view_id}));
  SCANTROVE_TRY(storeImages(connection, view_id, summary));
  return view.object;
}

Result<void> storeColors(DatabaseConnection& connection, std::int64_t id) {
  const auto view_id = static_cast<qlonglong>(id);
  Result<QSqlQuery> query = connection.execute("SELECT color, mask FROM views WHERE id = ?", {view_id});
  if (!query) return fail(query.error());
  ObjectView view;
  if (query->next()) {
    view.color = decodedImage(query->value(0).toByteArray());
    view.mask = decodedImage(query->value(1).toByteArray());
  }
  const auto colors = flawOf(view).empty() ? describeColors(view.color, view.mask) : std::nullopt;
  SCANTROVE_TRY(
      connection.execute("UPDATE descriptors SET colors = ? WHERE view = ?", {colorsBlob(colors), view_id}));
  return {};
}

Result<void> refreshObject(DatabaseConnection& connection, ObjectId object) {
  Result<QSqlQuery> query = connection.execute(
      "SELECT v.id, s.size_x_m, s.size_y_m, s.size_z_m FROM views v JOIN view_summaries s ON s.view = v.id"
      " WHERE v.object = ? ORDER BY s.object_pixels DESC NULLS LAST, v.id DESC",
      {object.value});
  if (!query) return fail(query.error());
  MedianSize size;
  QVariant best_view{QMetaType(QMetaType::LongLong)};
  while (query->next()) {
    if (best_view.isNull()) best_view = query->value(0);
    size.add({query->value(1).toFloat(), query->value(2).toFloat(), query->value(3).toFloat()});
  }
  SCANTROVE_TRY(
      connection.execute("UPDATE objects SET best_view = ? WHERE id = ?", {best_view, object.value}));
  if (best_view.isNull()) return {};  // hidden: its own size comes back with its views
  // Zero if none of its own views has a size: the stored one came from an object that was merged with it.
  const Eigen::Vector3f size_m = size.value_m();
  SCANTROVE_TRY(connection.execute("UPDATE objects SET size_x_m = ?, size_y_m = ?, size_z_m = ? WHERE id = ?",
                                   {size_m.x(), size_m.y(), size_m.z(), object.value}));
  return {};
}

void warnOfView(const DatabaseConnection& connection, std::int64_t view, ObjectId object,
                const std::string& flaw) {
  spdlog::warn("View {} of object {} in {} is left out: {}.", view, object.value, connection.file(), flaw);
}

}  // namespace scantrove
