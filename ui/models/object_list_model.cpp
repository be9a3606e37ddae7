#include "ui/models/object_list_model.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace scantrove {

QString viewsInWords(int views) {
  return views == 1 ? ObjectListModel::tr("1 view") : ObjectListModel::tr("%1 views").arg(views);
}

QImage viewPicture(const ObjectView& view) {
  const cv::Mat& color = view.color;
  if (color.empty() || color.type() != CV_8UC3) return {};
  const bool masked = view.mask.size() == color.size() && view.mask.type() == CV_8UC1;
  QImage picture(color.cols, color.rows, QImage::Format_RGB888);
  for (int y = 0; y < color.rows; ++y) {
    const auto* in = color.ptr<cv::Vec3b>(y);
    const std::uint8_t* mask = masked ? view.mask.ptr<std::uint8_t>(y) : nullptr;
    uchar* out = picture.scanLine(y);
    for (int x = 0; x < color.cols; ++x) {
      const bool object = mask == nullptr || mask[x] != 0;
      for (int c = 0; c < 3; ++c) {
        const int value = in[x][2 - c];
        out[3 * x + c] = static_cast<uchar>(object ? value : value * 2 / 5);
      }
    }
  }
  return picture;
}

ObjectListModel::ObjectListModel(CatalogueEditor& editor, QObject* parent)
    : QAbstractListModel(parent), editor_(editor) {
  connect(&editor_, &CatalogueEditor::changed, this, &ObjectListModel::reload);
  reload();
}

int ObjectListModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

QVariant ObjectListModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const Row& row = rows_[static_cast<std::size_t>(index.row())];
  const ObjectRecord& record = row.record;
  const auto size_text = [&record] {
    const auto cm = [](float metres) { return QString::number(std::lround(100 * metres)); };
    return tr("%1×%2×%3 cm").arg(cm(record.size_m.x()), cm(record.size_m.y()), cm(record.size_m.z()));
  };
  switch (role) {
    case Qt::DisplayRole:
    case Qt::EditRole:
      return QString::fromStdString(record.name);
    case Qt::DecorationRole:
      return row.thumbnail;
    case Qt::AccessibleTextRole:
      return tr("%1, %2, %3")
          .arg(QString::fromStdString(record.name), record.confirmed ? tr("confirmed") : tr("not confirmed"),
               viewsInWords(record.views));
    case Qt::ToolTipRole:
      return tr("<b>%1</b><br>%2, %3<br>First seen in: %4<br>%5")
          .arg(QString::fromStdString(record.name).toHtmlEscaped(), size_text(), viewsInWords(record.views),
               QString::fromStdString(record.first_session_name).toHtmlEscaped(),
               record.confirmed ? tr("Confirmed") : tr("Not yet confirmed: F2 names it, Return confirms it"));
    case ObjectIdRole:
      return record.id.value;
    case ConfirmedRole:
      return record.confirmed;
    case ViewCountRole:
      return record.views;
    case SizeTextRole:
      return size_text();
    case InViewRole:
      return in_view_.contains(record.id);
    case RecognisedRole:
      return recognised_.contains(record.id);
    case AddedNowRole:
      return added_.contains(record.id);
    default:
      return {};
  }
}

bool ObjectListModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  const ObjectId object = objectAt(index);
  if (!object) return false;
  if (role == Qt::EditRole) return editor_.rename(object, value.toString());
  if (role == ConfirmedRole) return editor_.setConfirmed(object, value.toBool());
  return false;
}

Qt::ItemFlags ObjectListModel::flags(const QModelIndex& index) const {
  const Qt::ItemFlags common = QAbstractListModel::flags(index);
  return index.isValid() ? common | Qt::ItemIsEditable : common;
}

void ObjectListModel::reload() {
  std::vector<ObjectRecord> records = editor_.objects();
  std::sort(records.begin(), records.end(), [](const auto& a, const auto& b) { return a.id > b.id; });
  const auto same_id = [](const Row& row, const ObjectRecord& record) { return row.record.id == record.id; };
  if (std::equal(rows_.begin(), rows_.end(), records.begin(), records.end(), same_id)) {
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].record.views != records[i].views) rows_[i].thumbnail = makeThumbnail(records[i].id);
      rows_[i].record = std::move(records[i]);
    }
    emitAll({});
    return;
  }
  // Rows go and come one by one, so that views keep selection and scroll position.
  std::map<ObjectId, std::size_t> wanted;
  for (std::size_t i = 0; i < records.size(); ++i) wanted[records[i].id] = i;
  for (int i = rowCount() - 1; i >= 0; --i) {
    if (wanted.contains(rows_[static_cast<std::size_t>(i)].record.id)) continue;
    beginRemoveRows({}, i, i);
    rows_.erase(rows_.begin() + i);
    endRemoveRows();
  }
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (i < rows_.size() && rows_[i].record.id == records[i].id) {
      if (rows_[i].record.views != records[i].views) rows_[i].thumbnail = makeThumbnail(records[i].id);
      rows_[i].record = records[i];
      continue;
    }
    const int at = static_cast<int>(i);
    beginInsertRows({}, at, at);
    rows_.insert(rows_.begin() + at, Row{records[i], makeThumbnail(records[i].id)});
    endInsertRows();
  }
  emitAll({});
}

void ObjectListModel::refresh(ObjectId object) {
  if (!indexOf(object).isValid()) {
    reload();
    return;
  }
  for (const ObjectRecord& record : editor_.objects()) {
    if (record.id != object) continue;
    const QModelIndex index = indexOf(object);
    Row& row = rows_[static_cast<std::size_t>(index.row())];
    row = Row{record, makeThumbnail(object)};
    emit dataChanged(index, index);
  }
}

void ObjectListModel::beginScan() {
  added_.clear();
  recognised_.clear();
  in_view_.clear();
  reload();
}

void ObjectListModel::markAdded(ObjectId object) {
  added_.insert(object);
  reload();
}

void ObjectListModel::markRecognised(ObjectId object) {
  recognised_.insert(object);
  emitAll({RecognisedRole});
}

void ObjectListModel::setInView(const std::vector<SeenObject>& seen) {
  std::set<ObjectId> now;
  for (const SeenObject& object : seen) {
    if (object.object) now.insert(object.object);
  }
  if (now == in_view_) return;
  in_view_ = std::move(now);
  emitAll({InViewRole});
}

ObjectId ObjectListModel::objectAt(const QModelIndex& index) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  return rows_[static_cast<std::size_t>(index.row())].record.id;
}

QModelIndex ObjectListModel::indexOf(ObjectId object) const {
  for (int i = 0; i < rowCount(); ++i) {
    if (rows_[static_cast<std::size_t>(i)].record.id == object) return index(i);
  }
  return {};
}

const ObjectRecord* ObjectListModel::record(ObjectId object) const {
  const QModelIndex index = indexOf(object);
  return index.isValid() ? &rows_[static_cast<std::size_t>(index.row())].record : nullptr;
}

int ObjectListModel::confirmedCount() const {
  return static_cast<int>(
      std::count_if(rows_.begin(), rows_.end(), [](const Row& row) { return row.record.confirmed; }));
}

void ObjectListModel::emitAll(const QList<int>& roles) {
  if (!rows_.empty()) emit dataChanged(index(0), index(rowCount() - 1), roles);
}

QImage ObjectListModel::makeThumbnail(ObjectId object) {
  ObjectView view;
  view.color = editor_.picture(object);
  return viewPicture(view);
}

}  // namespace scantrove
