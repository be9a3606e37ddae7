#include "core/catalogue/view_store.h"

#include <QStringList>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <set>

#include "core/catalogue/event_rows.h"
#include "core/catalogue/image_blob.h"
#include "core/catalogue/object_rows.h"
#include "core/catalogue/view_rows.h"
#include "core/database/database_connection.h"
#include "core/database/transaction.h"

namespace scantrove {
namespace {

QString toText(const Eigen::Isometry3d& T) {
  QStringList numbers;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) numbers << QString::number(T.matrix()(row, column), 'g', 17);
  }
  return numbers.join(' ');
}

std::optional<Eigen::Isometry3d> toPose(const QString& text) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  const QStringList numbers = text.split(' ');
  if (numbers.size() != 12) return std::nullopt;
  bool is_number = true;
  for (int i = 0; i < 12 && is_number; ++i) T.matrix()(i / 4, i % 4) = numbers[i].toDouble(&is_number);
  return is_number && T.matrix().allFinite() ? std::optional(T) : std::nullopt;
}

/// Fills an image from its column; returns the flaw, if any.
std::string readImage(const QSqlQuery& query, int column, const char* what, cv::Mat& image) {
  const QByteArray bytes = query.value(column).toByteArray();
  image = decodedImage(bytes);
  return image.empty() && !bytes.isEmpty() ? std::string("its ") + what + " is not an image" : std::string();
}

/// Six values for readBox(); nulls if the box is unknown.
QVariantList boxColumns(const ObjectView& view) {
  if (view.frame_px.empty()) return QVariantList(6, QVariant(QMetaType(QMetaType::Int)));
  const cv::Rect& box = view.box_px;
  return {box.x, box.y, box.width, box.height, view.frame_px.width, view.frame_px.height};
}

/// The box and its frame from six columns; both empty if unknown or invalid.
void readBox(const QSqlQuery& query, int column, ObjectView& view) {
  constexpr int kLargestSide_px = 4096;  // of supported images
  std::array<int, 6> numbers{};
  for (int i = 0; i < 6; ++i) {
    numbers[static_cast<std::size_t>(i)] = query.value(column + i).toInt();
    if (numbers[static_cast<std::size_t>(i)] < 0 || numbers[static_cast<std::size_t>(i)] > kLargestSide_px)
      return;
  }
  const auto [x, y, width, height, frame_width, frame_height] = numbers;
  const cv::Rect box(x, y, width, height);
  const cv::Rect frame(0, 0, frame_width, frame_height);
  if (box.empty() || (box & frame) != box) return;
  view.box_px = box;
  view.frame_px = frame.size();
}

/// Fills a view from its row; returns the flaw, if any.
std::string readView(const QSqlQuery& query, ObjectView& view) {
  view.id = query.value(0).toLongLong();
  view.object = ObjectId{query.value(1).toUInt()};
  view.session = query.value(2).toLongLong();
  view.frame_index = query.value(3).toInt();
  for (int i = 0; i < 3; ++i) {
    view.direction[i] = query.value(5 + i).toFloat();
    view.size_m[i] = query.value(8 + i).toFloat();
  }
  readBox(query, 14, view);
  const std::optional<Eigen::Isometry3d> pose = toPose(query.value(4).toString());
  if (!pose) return "its pose is not twelve numbers";
  view.T_world_camera = *pose;
  std::string flaw = readImage(query, 11, "colour", view.color);
  if (flaw.empty()) flaw = readImage(query, 12, "mask", view.mask);
  if (flaw.empty()) flaw = readImage(query, 13, "depth", view.depth_mm);
  return flaw.empty() ? flawOf(view) : flaw;
}

constexpr int kViewsOfATransaction = 100;  // keeps the write lock well below a second

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
    std::set<ObjectId> owners;
    for (const std::int64_t view : views) {
      const Result<ObjectId> owner = summarizeStoredView(connection, view);
      if (!owner) return fail(owner.error());
      owners.insert(*owner);
    }
    for (const ObjectId owner : owners) SCANTROVE_TRY(refreshObject(connection, owner));
    return {};
  });
}

/// Describes views that an older version stored.
Result<void> summarizeOlderViews(DatabaseConnection& connection) {
  for (;;) {
    const Result<std::vector<std::int64_t>> views = viewsWithoutSummary(connection);
    if (!views) return fail(views.error());
    if (views->empty()) return {};
    SCANTROVE_TRY(summarizeViews(connection, *views));
  }
}

Result<void> storeColorsOf(DatabaseConnection& connection, const std::vector<std::int64_t>& views) {
  return inTransaction(connection, [&]() -> Result<void> {
    for (const std::int64_t view : views) SCANTROVE_TRY(storeColors(connection, view));
    return {};
  });
}

/// The first views after `after` that an older version described.
Result<std::vector<std::int64_t>> viewsWithoutColors(DatabaseConnection& connection, std::int64_t after) {
  Result<QSqlQuery> query = connection.execute(
      "SELECT view FROM descriptors WHERE colors IS NULL AND view > ? ORDER BY view LIMIT ?",
      {static_cast<qlonglong>(after), kViewsOfATransaction});
  if (!query) return fail(query.error());
  std::vector<std::int64_t> views;
  while (query->next()) views.push_back(query->value(0).toLongLong());
  return views;
}

/// Computes the colours of views that an older version described. Asks for each view once, because a damaged
/// index may name views that cannot be changed.
Result<void> describeOlderColors(DatabaseConnection& connection) {
  std::int64_t last = std::numeric_limits<std::int64_t>::min();
  for (;;) {
    const Result<std::vector<std::int64_t>> views = viewsWithoutColors(connection, last);
    if (!views) return fail(views.error());
    if (views->empty() || views->back() <= last) return {};
    SCANTROVE_TRY(storeColorsOf(connection, *views));
    last = views->back();
  }
}

/// None: the view has no colours.
std::optional<ViewColors> readColors(const QSqlQuery& query, int column) {
  const QByteArray roots = query.value(column).toByteArray();
  if (roots.size() != static_cast<qsizetype>(ViewColors::kBins)) return std::nullopt;
  ViewColors colors;
  std::ranges::transform(roots, colors.roots.begin(),
                         [](char root) { return static_cast<std::uint8_t>(root); });
  return colors;
}

/// A network's hash and vector from two columns. None: the view has no vector, or one of another length
/// than 1.
std::optional<NetworkVector> readVector(const QSqlQuery& query, int column) {
  const QByteArray bytes = query.value(column + 1).toByteArray();
  if (bytes.isEmpty() || bytes.size() % static_cast<qsizetype>(sizeof(float)) != 0) return std::nullopt;
  NetworkVector vector{query.value(column).toString().toStdString(), {}};
  vector.values.resize(static_cast<std::size_t>(bytes.size()) / sizeof(float));
  std::memcpy(vector.values.data(), bytes.constData(), static_cast<std::size_t>(bytes.size()));
  double squares = 0;
  for (const float value : vector.values) squares += static_cast<double>(value) * value;
  const bool is_unit = std::abs(squares - 1) < 0.01;  // false for NaN
  return is_unit ? std::optional(std::move(vector)) : std::nullopt;
}

/// False: the row is unusable.
bool readThumbnail(const QSqlQuery& query, int column, Thumbnail& thumbnail) {
  for (int i = 0; i < 3; ++i) thumbnail.mean_lab[i] = query.value(column + i).toFloat();
  const QByteArray fine = query.value(column + 3).toByteArray();
  if (fine.size() != static_cast<qsizetype>(thumbnail.fine.size()) || !thumbnail.mean_lab.allFinite())
    return false;
  std::ranges::copy(fine, thumbnail.fine.begin());
  fillCoarse(thumbnail);
  return true;
}

/// Session and position from four columns.
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

Result<std::vector<ObjectView>> ViewStore::of(ObjectId id) {
  Result<QSqlQuery> query = connection_.execute(
      "SELECT v.id, v.object, v.session, v.frame_index, v.pose, v.direction_x, v.direction_y, v.direction_z,"
      " s.size_x_m, s.size_y_m, s.size_z_m, v.color, v.mask, v.depth_mm,"
      " v.box_x, v.box_y, v.box_width, v.box_height, v.frame_width, v.frame_height"
      " FROM views v LEFT JOIN view_summaries s ON s.view = v.id WHERE v.object = ? ORDER BY v.id",
      {id.value});
  if (!query) return fail(query.error());
  std::vector<ObjectView> views;
  while (query->next()) {
    ObjectView view;
    const std::string flaw = readView(*query, view);
    if (flaw.empty()) {
      views.push_back(std::move(view));
    } else {
      warnOfView(connection_, view.id, view.object, flaw);
    }
  }
  return views;
}

Result<std::int64_t> ViewStore::insert(ObjectView view) {
  if (const std::string flaw = flawOf(view); !flaw.empty()) {
    return fail("The view of object " + std::to_string(view.object.value) + " in frame " +
                std::to_string(view.frame_index) + " was not stored in " + connection_.file() + ": " + flaw +
                ".");
  }
  ObjectRows rows(connection_);
  SCANTROVE_TRY(rows.read(view.object));
  if (const auto object = rows.model().known(view.object); !object) return fail(object.error());
  const ObjectId owner = rows.model().viewOwner(view.object);
  QVariantList values{owner.value,
                      view.object.value,
                      orNull(view.session),
                      view.frame_index,
                      toText(view.T_world_camera),
                      view.direction.x(),
                      view.direction.y(),
                      view.direction.z(),
                      DatabaseConnection::now(),
                      toPng(view.color),
                      toPng(view.mask),
                      toPng(view.depth_mm)};
  values += boxColumns(view);
  SCANTROVE_TRY(moveInto(
      view.id,
      connection_.insert(
          "INSERT INTO views (object, first_object, session, frame_index, pose, direction_x, direction_y,"
          " direction_z, created, color, mask, depth_mm, box_x, box_y, box_width, box_height, frame_width,"
          " frame_height) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
          values)));
  SCANTROVE_TRY(insertSummary(connection_, view, summarize(view)));
  SCANTROVE_TRY(refreshObject(connection_, owner));
  SCANTROVE_TRY(recordEvent(connection_, action::kAddView, owner, {},
                            {{"view", static_cast<qint64>(view.id)}}, view.session));
  return view.id;
}

Result<std::int64_t> ViewStore::forEachDescriptor(std::int64_t after,
                                                  const std::function<void(const StoredDescriptor&)>& visit) {
  SCANTROVE_TRY(summarizeOlderViews(connection_));
  SCANTROVE_TRY(describeOlderColors(connection_));
  Result<QSqlQuery> query = connection_.execute(
      "SELECT d.view, s.first_object, s.size_x_m, s.size_y_m, s.size_z_m, d.mean_l, d.mean_a, d.mean_b,"
      " d.fine, s.session, s.place_x_m, s.place_y_m, s.place_z_m, d.colors, n.network, n.vector"
      " FROM descriptors d JOIN view_summaries s ON s.view = d.view"
      " LEFT JOIN view_vectors n ON n.view = d.view WHERE d.view > ? ORDER BY d.view",
      {static_cast<qlonglong>(after)});
  if (!query) return fail(query.error());
  StoredDescriptor stored;
  stored.view = after;
  while (query->next()) {
    stored.view = query->value(0).toLongLong();
    stored.first_object = ObjectId{query->value(1).toUInt()};
    for (int i = 0; i < 3; ++i) stored.size_m[i] = query->value(2 + i).toFloat();
    stored.place = readPlace(*query, 9);
    stored.descriptor.colors = readColors(*query, 13);
    stored.descriptor.network = readVector(*query, 14);
    if (readThumbnail(*query, 5, stored.descriptor.thumbnail)) {
      visit(stored);
    } else {
      warnOfView(connection_, stored.view, stored.first_object, "its descriptor is damaged");
    }
  }
  return stored.view;
}

Result<int> ViewStore::count() {
  Result<QSqlQuery> query = connection_.execute("SELECT count(*) FROM view_summaries");
  if (!query) return fail(query.error());
  return query->next() ? query->value(0).toInt() : 0;
}

Result<cv::Mat> ViewStore::picture(ObjectId id) {
  constexpr const char* kSelect =
      "SELECT o.best_view, p.jpeg, s.object_pixels IS NULL FROM objects o"
      " LEFT JOIN pictures p ON p.view = o.best_view LEFT JOIN view_summaries s ON s.view = o.best_view"
      " WHERE o.id = ?";
  Result<QSqlQuery> query = connection_.execute(kSelect, {id.value});
  if (!query) return fail(query.error());
  if (!query->next() || query->value(0).isNull()) return cv::Mat();
  if (query->value(2).toBool()) {
    SCANTROVE_TRY(summarizeViews(connection_, {query->value(0).toLongLong()}));
    query = connection_.execute(kSelect, {id.value});
    if (!query) return fail(query.error());
    if (!query->next()) return cv::Mat();
  }
  return decodedImage(query->value(1).toByteArray());
}

Result<std::vector<cv::Mat>> ViewStore::pictures(ObjectId id) {
  Result<QSqlQuery> query = connection_.execute(
      "SELECT v.id FROM views v JOIN view_summaries s ON s.view = v.id"
      " WHERE v.object = ? AND s.object_pixels IS NULL",
      {id.value});
  if (!query) return fail(query.error());
  std::vector<std::int64_t> older;
  while (query->next()) older.push_back(query->value(0).toLongLong());
  if (!older.empty()) SCANTROVE_TRY(summarizeViews(connection_, older));

  query = connection_.execute(
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
