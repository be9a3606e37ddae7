#pragma once
#include <QListView>
#include <QPersistentModelIndex>
#include <QPoint>
#include <utility>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

class CatalogueEditor;
class NameEditor;
class ObjectFilter;
class ObjectListModel;

/// The list of objects, filtered and sorted (ObjectFilter). Changes of the catalogue keep the selection, the
/// typed name and the scroll position. If a selected object is merged into another, that one is selected. The
/// list scrolls to new rows only while the user does not use it. A double click on a picture opens the
/// object's page, one beside it the field for the name.
class ObjectListView : public QListView {
  Q_OBJECT

 public:
  ObjectListView(CatalogueEditor& editor, ObjectListModel& model, QWidget* parent = nullptr);

  [[nodiscard]] ObjectFilter& filter() { return *filter_; }
  /// Invalid: the object is not in the list now.
  [[nodiscard]] QModelIndex rowOf(ObjectId object) const;
  /// Oldest first.
  [[nodiscard]] std::vector<ObjectId> selection() const;
  /// Selects those that are in the list, and shows the first.
  void select(const std::vector<ObjectId>& objects);
  void selectNewest();
  void editName(ObjectId object);
  /// False if the typed name cannot be stored.
  bool finishEditing();
  /// A mouse button is down in the list, so rows should not change.
  [[nodiscard]] bool isPressed() const;
  /// Number of objects of this scan below the visible rows.
  [[nodiscard]] int newBelow() const;
  [[nodiscard]] NameEditor* nameEditor() const { return name_editor_; }

 signals:
  void newBelowChanged();
  void pageRequested(scantrove::ObjectId object);

 protected:
  bool viewportEvent(QEvent* event) override;
  void updateGeometries() override;

 private:
  [[nodiscard]] bool isUsed() const;
  void storeScrollPosition();
  void restoreScrollPosition();
  void moveSelection(ObjectId into, ObjectId from);

  ObjectListModel& model_;
  ObjectFilter* filter_;
  NameEditor* name_editor_;
  std::vector<std::pair<QPersistentModelIndex, int>>
      visible_rows_;  ///< and their top positions, best anchor first
  bool was_at_end_ = false;
  bool pressed_ = false;
  QPoint double_clicked_;  ///< in the viewport
};

}  // namespace scantrove
