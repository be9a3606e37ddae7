#pragma once
#include <QCollator>
#include <QSortFilterProxyModel>
#include <QString>

#include "ui/models/object_list_model.h"

namespace scantrove {

/// The rows of the object list that a user wants to see, in the order wanted. Compares prepared lower-case
/// text of ObjectListModel::rows(), and rearranges the list at once, so that it answers quickly. Text is
/// sorted as in the user's language, numbers in it by their value: "chair 2" before "chair 10".
class ObjectFilter : public QSortFilterProxyModel {
  Q_OBJECT

 public:
  enum class Shown { all, named, confirmed, without_name, in_view, in_scan, changed, of_class };
  enum class Order { oldest, newest, name, object_class, views, size };

  /// `model` outlives this.
  explicit ObjectFilter(ObjectListModel& model, QObject* parent = nullptr);

  /// Every word must be in the name or in the class. Empty: all objects.
  void setSearch(const QString& text);
  /// `class_id`: for Shown::of_class; none: objects without class.
  void setShown(Shown shown, ClassId class_id = {});
  void setOrder(Order order);
  [[nodiscard]] Shown shown() const { return shown_; }
  [[nodiscard]] ClassId shownClass() const { return class_id_; }
  [[nodiscard]] Order order() const { return order_; }
  /// Whether it hides anything.
  [[nodiscard]] bool isFiltering() const { return shown_ != Shown::all || !words_.isEmpty(); }

  [[nodiscard]] ObjectId objectAt(const QModelIndex& row) const { return model_.objectAt(mapToSource(row)); }
  /// Invalid: not in the list now.
  [[nodiscard]] QModelIndex indexOf(ObjectId object) const { return mapFromSource(model_.indexOf(object)); }
  /// Number of objects that this scan added below that row.
  [[nodiscard]] int addedBelow(int row) const;
  /// Objects in the list that a user named, or confirmed.
  [[nodiscard]] int namedCount() const;
  [[nodiscard]] int confirmedCount() const;

 protected:
  [[nodiscard]] bool filterAcceptsRow(int row, const QModelIndex& parent) const override;
  [[nodiscard]] bool lessThan(const QModelIndex& left, const QModelIndex& right) const override;

 private:
  [[nodiscard]] bool isShown(const ObjectListModel::Row& row) const;
  [[nodiscard]] const ObjectListModel::Row& rowOf(int row) const {
    return model_.rows()[static_cast<std::size_t>(row)];
  }

  ObjectListModel& model_;
  QStringList words_;
  Shown shown_ = Shown::all;
  ClassId class_id_;
  Order order_ = Order::oldest;
  QCollator collator_;
};

}  // namespace scantrove
