// The views of ObjectDatabase: images and poses in and out of the table `views`.
#include <QStringList>
#include <array>
#include <optional>

#include "core/catalogue/image_blob.h"
#include "core/catalogue/object_database.h"
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

/// Fills an image from its column; returns what is wrong with it.
std::string readImage(const QSqlQuery& query, int column, const char* what, cv::Mat& image) {
  const QByteArray bytes = query.value(column).toByteArray();
  image = decodedImage(bytes);
  return image.empty() && !bytes.isEmpty() ? std::string("its ") + what + " is not an image" : std::string();
}

/// Six values for readBox(); nulls where the box is not known.
QVariantList boxColumns(const ObjectView& view) {
  if (view.frame_px.empty()) return QVariantList(6, QVariant(QMetaType(QMetaType::Int)));
  const cv::Rect& box = view.box_px;
  return {box.x, box.y, box.width, box.height, view.frame_px.width, view.frame_px.height};
}

/// The box and its frame from six columns; both empty where they are not known or make no sense.
void readBox(const QSqlQuery& query, int column, ObjectView& view) {
  constexpr int kLargestSide_px = 4096;  // of the images that can be scanned
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

/// Fills a view from its row; returns what is wrong with it.
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

}  // namespace

Result<std::vector<ObjectView>> ObjectDatabase::views(ObjectId id) {
  Result<QSqlQuery> query = connection_->execute(
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
      warnOfView(*connection_, view.id, view.object, flaw);
    }
  }
  return views;
}

Result<std::int64_t> ObjectDatabase::addView(const ObjectView& view, const Check& check) {
  return inTransaction(*connection_, [&]() -> Result<std::int64_t> {
    SCANTROVE_TRY(check());
    return insertView(view);
  });
}

Result<std::int64_t> ObjectDatabase::insertView(ObjectView view) {
  if (const std::string flaw = flawOf(view); !flaw.empty()) {
    return fail("The view of object " + std::to_string(view.object.value) + " in frame " +
                std::to_string(view.frame_index) + " was not stored in " + connection_->file() + ": " + flaw +
                ".");
  }
  const Result<ObjectRow> root = mergeRootOf(*connection_, view.object);
  if (!root) return fail(root.error());
  QVariantList values{root->id.value,
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
      connection_->insert(
          "INSERT INTO views (object, first_object, session, frame_index, pose, direction_x, direction_y,"
          " direction_z, created, color, mask, depth_mm, box_x, box_y, box_width, box_height, frame_width,"
          " frame_height) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
          values)));
  SCANTROVE_TRY(insertSummary(*connection_, view, summarize(view)));
  SCANTROVE_TRY(refreshObject(*connection_, root->id));
  SCANTROVE_TRY(recordEvent(*connection_, event::kAddView, root->id, {},
                            {{"view", static_cast<qint64>(view.id)}}, view.session));
  return view.id;
}

}  // namespace scantrove
