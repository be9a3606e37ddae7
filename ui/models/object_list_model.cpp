#include "ui/models/object_list_model.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace scantrove {
namespace {

constexpr int kPictureCache_bytes = 32 << 20;

}  // namespace

QString sizeInWords(const Eigen::Vector3f& size_m) {
  const auto cm = [](float meters) { return QString::number(std::lround(100 * meters)); };
  return ObjectListModel::tr("%1 × %2 × %3 cm").arg(cm(size_m.x()), cm(size_m.y()), cm(size_m.z()));
}

QString viewsInWords(int views) { return ObjectListModel::tr("%n views", nullptr, views); }

QString sidesInWords(const SeenSides& seen) {
  return seen.isComplete()
             ? ObjectListModel::tr("seen from all sides")
             : ObjectListModel::tr("seen from %1 of %2 sides").arg(seen.count()).arg(SeenSides::kSides);
}

ObjectListModel::ObjectListModel(CatalogueEditor& editor, QObject* parent)
    : QAbstractListModel(parent), editor_(editor), pictures_(kPictureCache_bytes) {
  connect(&editor_, &CatalogueEditor::opened, this, &ObjectListModel::readAll);
  connect(&editor_, &CatalogueEditor::changed, this, &ObjectListModel::applyChanges);
  readAll();
}

int ObjectListModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

QVariant ObjectListModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  const Row& row = rows_[static_cast<std::size_t>(index.row())];
  const ObjectRecord& record = row.record;
  switch (role) {
    case Qt::DisplayRole:
      return QString::fromStdString(record.name);
    case Qt::DecorationRole:
      return picture(record.id);
    case Qt::AccessibleTextRole:
      return tr("%1, %2, %3, %4")
          .arg(QString::fromStdString(record.name),
               row.class_name.isEmpty() ? tr("no class") : tr("class %1").arg(row.class_name),
               record.confirmed ? tr("confirmed") : tr("not confirmed"), viewsInWords(record.views));
    case Qt::ToolTipRole:
      return toolTip(row);
    case ObjectIdRole:
      return record.id.value;
    case ConfirmedRole:
      return record.confirmed;
    case ViewCountRole:
      return record.views;
    case SizeTextRole:
      return sizeInWords(record.size_m);
    case InViewRole:
      return in_view_.contains(record.id);
    case RecognizedRole:
      return isRecognized(record.id);
    case AddedNowRole:
      return added_.contains(record.id) && !isSettled(record);
    case ChangeRole: {
      const auto change = changed_.find(record.id);
      return change == changed_.end() ? QString() : change->second;
    }
    case ClassNameRole:
      return row.class_name;
    case ClassColorRole:
      return row.class_color.isValid() ? QVariant(row.class_color) : QVariant();
    case SeenSidesRole: {
      const auto sides = seen_sides_.find(record.id);
      return sides == seen_sides_.end() ? QVariant() : QVariant::fromValue(sides->second);
    }
    default:
      return {};
  }
}

QString ObjectListModel::toolTip(const Row& row) const {
  const ObjectRecord& record = row.record;
  const auto sides = seen_sides_.find(record.id);
  const QString class_line =
      row.class_name.isEmpty() ? QString() : tr("Class: %1<br>").arg(row.class_name.toHtmlEscaped());
  const auto change = changed_.find(record.id);
  const QString change_line =
      change == changed_.end() ? QString() : QStringLiteral("<br>") + change->second.toHtmlEscaped();
  const QString text =
      tr("<b>%1</b><br>%7%2, %3<br>%4First seen in: %5<br>%6")
          .arg(QString::fromStdString(record.name).toHtmlEscaped(), sizeInWords(record.size_m),
               viewsInWords(record.views),
               sides == seen_sides_.end() ? QString()
                                          : tr("In this scan %1<br>").arg(sidesInWords(sides->second)),
               QString::fromStdString(record.first_session_name).toHtmlEscaped(),
               record.confirmed ? tr("Confirmed") : tr("Not confirmed: F2 renames, Return confirms"),
               class_line);
  return text + change_line;
}

QImage ObjectListModel::picture(ObjectId object) const {
  if (const QImage* known = pictures_.object(object.value)) return *known;
  QImage read = editor_.picture(object);
  pictures_.insert(object.value, new QImage(read), std::max<qsizetype>(1, read.sizeInBytes()));
  return read;
}

void ObjectListModel::readAll() {
  beginResetModel();
  classes_ = editor_.catalogue().classes();
  rows_.clear();
  for (ObjectRecord& record : editor_.objects()) rows_.push_back(rowFor(std::move(record)));
  std::sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.record.id < b.record.id; });
  confirmed_count_ = static_cast<int>(
      std::count_if(rows_.begin(), rows_.end(), [](const Row& row) { return row.record.confirmed; }));
  pictures_.clear();
  endResetModel();
}

ObjectListModel::Row ObjectListModel::rowFor(ObjectRecord record) const {
  Row row;
  row.name_key = QString::fromStdString(record.name).toLower();
  if (const ObjectClass* own = classes_.rootOf(record.classification.class_id)) {
    row.class_id = own->id;
    row.class_name = QString::fromStdString(own->name);
    row.class_key = row.class_name.toLower();
    row.class_color = QColor(own->color[0], own->color[1], own->color[2]);
  }
  row.record = std::move(record);
  return row;
}

void ObjectListModel::updateClasses() {
  classes_ = editor_.catalogue().classes();
  for (Row& row : rows_) row = rowFor(std::move(row.record));
  if (!rows_.empty()) emit dataChanged(index(0), index(rowCount() - 1), {ClassNameRole, ClassColorRole});
}

void ObjectListModel::applyChanges(const CatalogueChanges& changes) {
  std::set<ObjectId> touched;
  for (const CatalogueChange& change : changes.changes) {
    if (change.of_class) continue;
    touched.insert(change.object());
    if (change.mergeTarget()) touched.insert(change.mergeTarget());
  }
  emit aboutToUpdate();
  if (std::ranges::any_of(changes.changes, [](const auto& change) { return change.of_class.has_value(); }))
    updateClasses();
  std::vector<ObjectId> removed;
  for (const ObjectId object : touched) {
    pictures_.remove(object.value);
    Result<std::optional<ObjectRecord>> record = editor_.object(object);
    if (!record) {
      editor_.announce(record.error());  // the row stays as it is
    } else if (*record) {
      insertOrUpdate(std::move(**record));
    } else {
      removed.push_back(object);
    }
  }
  for (const CatalogueChange& change : changes.changes) {
    if (change.kind == CatalogueChange::Kind::merged &&
        std::binary_search(removed.begin(), removed.end(), change.object()))
      emit merged(change.mergeTarget(), change.object());
  }
  for (const ObjectId object : removed) removeObject(object);
  emit updated();
}

void ObjectListModel::insertOrUpdate(ObjectRecord record) {
  const auto position = positionOf(record.id);
  const auto row = position - rows_.cbegin();
  confirmed_count_ += record.confirmed ? 1 : 0;
  if (position != rows_.cend() && position->record.id == record.id) {
    confirmed_count_ -= position->record.confirmed ? 1 : 0;
    const ObjectId object = record.id;
    rows_[static_cast<std::size_t>(row)] = rowFor(std::move(record));
    emitRow(object, {});
    return;
  }
  beginInsertRows({}, static_cast<int>(row), static_cast<int>(row));
  rows_.insert(position, rowFor(std::move(record)));
  endInsertRows();
}

void ObjectListModel::removeObject(ObjectId object) {
  const QModelIndex index = indexOf(object);
  if (!index.isValid()) return;
  const auto position = positionOf(object);
  confirmed_count_ -= position->record.confirmed ? 1 : 0;
  beginRemoveRows({}, index.row(), index.row());
  rows_.erase(position);
  endRemoveRows();
}

void ObjectListModel::beginScan() {
  added_.clear();
  recognized_.clear();
  in_view_.clear();
  seen_sides_.clear();
  changed_.clear();
  if (!rows_.empty()) {
    emit dataChanged(index(0), index(rowCount() - 1),
                     {InViewRole, RecognizedRole, AddedNowRole, SeenSidesRole, ChangeRole});
  }
}

void ObjectListModel::markAdded(ObjectId object) {
  added_.insert(object);
  emitRow(object, {AddedNowRole});
}

void ObjectListModel::markRecognized(ObjectId object) {
  recognized_.insert(object);
  emitRow(object, {RecognizedRole});
}

void ObjectListModel::setInView(const std::vector<SeenObject>& seen) {
  std::set<ObjectId> now;
  for (const SeenObject& object : seen) {
    if (object.object) now.insert(object.object);
  }
  std::vector<ObjectId> different;
  std::set_symmetric_difference(now.begin(), now.end(), in_view_.begin(), in_view_.end(),
                                std::back_inserter(different));
  in_view_ = std::move(now);
  for (const ObjectId object : different) emitRow(object, {InViewRole});
}

void ObjectListModel::setSeenSides(std::map<ObjectId, SeenSides> sides) {
  const auto before = std::exchange(seen_sides_, std::move(sides));
  for (const auto& [object, seen] : seen_sides_) {
    const auto same = before.find(object);
    if (same == before.end() || same->second != seen) emitRow(object, {SeenSidesRole});
  }
  for (const auto& [object, seen] : before) {
    if (!seen_sides_.contains(object)) emitRow(object, {SeenSidesRole});
  }
}

void ObjectListModel::setChanged(std::map<ObjectId, QString> changes) {
  const auto before = std::exchange(changed_, std::move(changes));
  for (const auto& [object, change] : changed_) {
    const auto same = before.find(object);
    if (same == before.end() || same->second != change) emitRow(object, {ChangeRole});
  }
  for (const auto& [object, change] : before) {
    if (!changed_.contains(object)) emitRow(object, {ChangeRole});
  }
}

ObjectId ObjectListModel::objectAt(const QModelIndex& index) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  return rows_[static_cast<std::size_t>(index.row())].record.id;
}

ObjectListModel::Rows::const_iterator ObjectListModel::positionOf(ObjectId object) const {
  return std::lower_bound(rows_.begin(), rows_.end(), object,
                          [](const Row& row, ObjectId requested) { return row.record.id < requested; });
}

QModelIndex ObjectListModel::indexOf(ObjectId object) const {
  const auto position = positionOf(object);
  if (position == rows_.end() || position->record.id != object) return {};
  return index(static_cast<int>(position - rows_.begin()));
}

const ObjectRecord* ObjectListModel::record(ObjectId object) const {
  const QModelIndex index = indexOf(object);
  return index.isValid() ? &rows_[static_cast<std::size_t>(index.row())].record : nullptr;
}

bool ObjectListModel::isInScan(ObjectId object) const {
  return seen_sides_.contains(object) || added_.contains(object) || recognized_.contains(object);
}

void ObjectListModel::emitRow(ObjectId object, const QList<int>& roles) {
  const QModelIndex row = indexOf(object);
  if (row.isValid()) emit dataChanged(row, row, roles);
}

}  // namespace scantrove
