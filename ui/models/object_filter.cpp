#include "ui/models/object_filter.h"

#include <QLocale>
#include <algorithm>

namespace scantrove {
namespace {

/// The user's; a collator of the C locale compares bytes.
QLocale sortingLocale() {
  const QLocale locale;
  return locale.language() == QLocale::C ? QLocale(QLocale::English) : locale;
}

}  // namespace

ObjectFilter::ObjectFilter(ObjectListModel& model, QObject* parent)
    : QSortFilterProxyModel(parent), model_(model), collator_(sortingLocale()) {
  collator_.setNumericMode(true);
  setSourceModel(&model_);
}

void ObjectFilter::setSearch(const QString& text) {
  const QStringList words = text.toLower().split(QLatin1Char(' '), Qt::SkipEmptyParts);
  if (words == words_) return;
  words_ = words;
  // Not invalidateFilter(), which removes row after row.
  invalidate();
}

void ObjectFilter::setShown(Shown shown, ClassId class_id) {
  if (shown == shown_ && class_id == class_id_) return;
  shown_ = shown;
  class_id_ = class_id;
  invalidate();
}

void ObjectFilter::setOrder(Order order) {
  if (order == order_) return;
  order_ = order;
  // The source is in the order of `oldest`.
  if (order_ == Order::oldest)
    sort(-1);
  else if (sortColumn() < 0)
    sort(0);
  else
    invalidate();
}

bool ObjectFilter::isShown(const ObjectListModel::Row& row) const {
  const ObjectRecord& record = row.record;
  switch (shown_) {
    case Shown::all:
      return true;
    case Shown::named:
      return record.named_by == NamedBy::user;
    case Shown::confirmed:
      return record.confirmed;
    case Shown::without_name:
      return record.named_by != NamedBy::user;
    case Shown::in_view:
      return model_.isInView(record.id);
    case Shown::in_scan:
      return model_.isInScan(record.id);
    case Shown::changed:
      return model_.isChanged(record.id);
    case Shown::of_class:
      return row.class_id == class_id_;
  }
  return true;
}

bool ObjectFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
  if (parent.isValid()) return false;
  const ObjectListModel::Row& object = rowOf(row);
  if (!isShown(object)) return false;
  return std::all_of(words_.begin(), words_.end(), [&object](const QString& word) {
    return object.name_key.contains(word) || object.class_key.contains(word);
  });
}

bool ObjectFilter::lessThan(const QModelIndex& left, const QModelIndex& right) const {
  const ObjectListModel::Row& a = rowOf(left.row());
  const ObjectListModel::Row& b = rowOf(right.row());
  switch (order_) {
    case Order::oldest:
      break;
    case Order::newest:
      return a.record.id > b.record.id;
    case Order::name:
      return collator_.compare(a.name_key, b.name_key) < 0;
    case Order::object_class: {
      // Objects without class are last.
      if (a.class_key.isEmpty() != b.class_key.isEmpty()) return b.class_key.isEmpty();
      const int order = collator_.compare(a.class_key, b.class_key);
      return order != 0 ? order < 0 : collator_.compare(a.name_key, b.name_key) < 0;
    }
    case Order::views:
      return a.record.views > b.record.views;
    case Order::size:
      return a.record.size_m.prod() > b.record.size_m.prod();
  }
  return a.record.id < b.record.id;
}

int ObjectFilter::addedBelow(int row) const {
  const std::set<ObjectId>& added = model_.added();
  return static_cast<int>(
      std::ranges::count_if(added, [&](ObjectId object) { return indexOf(object).row() > row; }));
}

int ObjectFilter::namedCount() const {
  int count = 0;
  for (int row = 0; row < rowCount(); ++row)
    count += rowOf(mapToSource(index(row, 0)).row()).record.named_by == NamedBy::user ? 1 : 0;
  return count;
}

int ObjectFilter::confirmedCount() const {
  int count = 0;
  for (int row = 0; row < rowCount(); ++row)
    count += rowOf(mapToSource(index(row, 0)).row()).record.confirmed ? 1 : 0;
  return count;
}

}  // namespace scantrove
