#pragma once
#include <QListView>
#include <QPersistentModelIndex>
#include <utility>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

class CatalogueEditor;
class NameEditor;
class ObjectListModel;

/// The list of objects. What arrives while a person works in it changes neither what is selected nor what is
/// typed, and does not move what the person looks at: a selected object that is merged into another hands its
/// selection on to that one; the newest rows scroll into view only while nobody's hand is in the list.
class ObjectListView : public QListView {
  Q_OBJECT

 public:
  ObjectListView(CatalogueEditor& editor, ObjectListModel& model, QWidget* parent = nullptr);

  /// Oldest first.
  [[nodiscard]] std::vector<ObjectId> selection() const;
  void selectNewest();
  void editName(ObjectId object);
  /// False: a name is being typed that cannot be stored.
  bool finishEditing();
  /// A mouse button is down in the list: rows should neither come nor go under it.
  [[nodiscard]] bool isHeld() const;
  /// Objects of this scan below what is visible.
  [[nodiscard]] int newBelow() const;

 signals:
  void newBelowChanged();

 protected:
  bool viewportEvent(QEvent* event) override;
  void updateGeometries() override;

 private:
  [[nodiscard]] bool isAttended() const;
  void rememberPlace();
  void restorePlace();
  void moveSelection(ObjectId into, ObjectId from);

  ObjectListModel& model_;
  NameEditor* name_editor_;
  std::vector<std::pair<QPersistentModelIndex, int>> visible_rows_;  ///< with their tops, best anchor first
  bool was_at_end_ = false;
  bool pressed_ = false;
};

}  // namespace scantrove
