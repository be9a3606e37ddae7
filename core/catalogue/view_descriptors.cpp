// What ObjectDatabase knows of views without their images: descriptors and pictures.
#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "core/catalogue/image_blob.h"
#include "core/catalogue/object_database.h"
#include "core/catalogue/view_rows.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"

namespace scantrove {
namespace {

constexpr int kViewsOfATransaction = 100;  // others wait for the write lock meanwhile: well below a second

Result<std::vector<std::int64_t>> viewsWithoutSummary(DatabaseConnection& connection) {
  Result<QSqlQuery> query =
      connection.execute("SELECT view FROM view_summaries WHERE object_pixels IS NULL ORDER BY view LIMIT ?",
                         {kViewsOfATransaction});
  if (!query) return fail(query.error());
  std::vector<std::int64_t> views;
  while (query->next()) views.push_back(query->value(0).toLongLong());
  return views;
}

Result<void> summarizeViews(DatabaseConnection& connection, const std::vector<std::int64_t>& views) {
  return inTransaction(connection, [&]() -> Result<void> {
    std::set<ObjectId> merge_roots;
    for (const std::int64_t view : views) {
      const Result<ObjectId> root = summarizeStoredView(connection, view);
      if (!root) return fail(root.error());
      merge_roots.insert(*root);
    }
    for (const ObjectId root : merge_roots) SCANTROVE_TRY(refreshObject(connection, root));
    return {};
  });
}

/// Views that an older version stored.
Result<void> summarizeOlderViews(DatabaseConnection& connection) {
  for (;;) {
    const Result<std::vector<std::int64_t>> views = viewsWithoutSummary(connection);
    if (!views) return fail(views.error());
    if (views->empty()) return {};
    SCANTROVE_TRY(summarizeViews(connection, *views));
  }
}

/// False when the row cannot be used.
bool readThumbnail(const QSqlQuery& query, int column, Thumbnail& thumbnail) {
  for (int i = 0; i < 3; ++i) thumbnail.mean_lab[i] = query.value(column + i).toFloat();
  const QByteArray fine = query.value(column + 3).toByteArray();
  if (fine.size() != static_cast<qsizetype>(thumbnail.fine.size()) || !thumbnail.mean_lab.allFinite())
    return false;
  std::ranges::copy(fine, thumbnail.fine.begin());
  fillCoarse(thumbnail);
  return true;
}

/// Session and place from four columns.
std::optional<ViewPlace> readPlace(const QSqlQuery& query, int column) {
  ViewPlace place;
  place.session = query.value(column).toLongLong();
  for (int i = 0; i < 3; ++i) {
    const QVariant value = query.value(column + 1 + i);
    place.centroid_world[i] = value.isNull() ? std::numeric_limits<float>::quiet_NaN() : value.toFloat();
  }
  const bool is_known = place.session != 0 && place.centroid_world.allFinite();
  return is_known ? std::optional(place) : std::nullopt;
}

}  // namespace

Result<std::int64_t> ObjectDatabase::forEachDescriptor(
    std::int64_t after, const std::function<void(const StoredDescriptor&)>& visit) {
  SCANTROVE_TRY(summarizeOlderViews(*connection_));
  Result<QSqlQuery> query = connection_->execute(
      "SELECT d.view, s.first_object, s.size_x_m, s.size_y_m, s.size_z_m, d.mean_l, d.mean_a, d.mean_b,"
      " d.fine, s.session, s.place_x_m, s.place_y_m, s.place_z_m"
      " FROM descriptors d JOIN view_summaries s ON s.view = d.view WHERE d.view > ? ORDER BY d.view",
      {static_cast<qlonglong>(after)});
  if (!query) return fail(query.error());
  StoredDescriptor descriptor;
  descriptor.view = after;
  while (query->next()) {
    descriptor.view = query->value(0).toLongLong();
    descriptor.first_object = ObjectId{query->value(1).toUInt()};
    for (int i = 0; i < 3; ++i) descriptor.size_m[i] = query->value(2 + i).toFloat();
    descriptor.place = readPlace(*query, 9);
    if (readThumbnail(*query, 5, descriptor.thumbnail)) {
      visit(descriptor);
    } else {
      warnOfView(*connection_, descriptor.view, descriptor.first_object, "its descriptor is damaged");
    }
  }
  return descriptor.view;
}

Result<int> ObjectDatabase::viewCount() {
  Result<QSqlQuery> query = connection_->execute("SELECT count(*) FROM view_summaries");
  if (!query) return fail(query.error());
  return query->next() ? query->value(0).toInt() : 0;
}

Result<cv::Mat> ObjectDatabase::picture(ObjectId id) {
  constexpr const char* kSelect =
      "SELECT o.best_view, p.jpeg, s.object_pixels IS NULL FROM objects o"
      " LEFT JOIN pictures p ON p.view = o.best_view LEFT JOIN view_summaries s ON s.view = o.best_view"
      " WHERE o.id = ?";
  Result<QSqlQuery> query = connection_->execute(kSelect, {id.value});
  if (!query) return fail(query.error());
  if (!query->next() || query->value(0).isNull()) return cv::Mat();
  if (query->value(2).toBool()) {
    SCANTROVE_TRY(summarizeViews(*connection_, {query->value(0).toLongLong()}));
    query = connection_->execute(kSelect, {id.value});
    if (!query) return fail(query.error());
    if (!query->next()) return cv::Mat();
  }
  return decodedImage(query->value(1).toByteArray());
}

Result<std::vector<cv::Mat>> ObjectDatabase::pictures(ObjectId id) {
  Result<QSqlQuery> query = connection_->execute(
      "SELECT v.id FROM views v JOIN view_summaries s ON s.view = v.id"
      " WHERE v.object = ? AND s.object_pixels IS NULL",
      {id.value});
  if (!query) return fail(query.error());
  std::vector<std::int64_t> older;
  while (query->next()) older.push_back(query->value(0).toLongLong());
  if (!older.empty()) SCANTROVE_TRY(summarizeViews(*connection_, older));

  query = connection_->execute(
      "SELECT p.jpeg FROM views v JOIN pictures p ON p.view = v.id WHERE v.object = ? ORDER BY v.id DESC",
      {id.value});
  if (!query) return fail(query.error());
  std::vector<cv::Mat> pictures;
  while (query->next()) {
    cv::Mat picture = decodedImage(query->value(0).toByteArray());
    if (!picture.empty()) pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace scantrove
