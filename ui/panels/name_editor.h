#pragma once
#include <QLineEdit>

#include "core/base/ids.h"

class QListView;

namespace scantrove {

class CatalogueEditor;
class ObjectListModel;

/// Field for renaming an object of the list. It belongs to an object, not to a row, so rows may change while
/// the user types. After a merge it renames the merged object. Return or leaving the field stores the name;
/// Escape cancels. If a name cannot be stored, it stays in the field and CatalogueEditor::failed gives the
/// reason.
class NameEditor : public QLineEdit {
  Q_OBJECT

 public:
  NameEditor(QListView& list, CatalogueEditor& editor, ObjectListModel& model);

  /// If the name of another object could not be stored, its field gets the focus instead.
  void begin(ObjectId object);
  /// Stores the name. False if it could not be stored.
  bool finish();
  void cancel();
  [[nodiscard]] bool isOpen() const { return bool(object_); }

 protected:
  void keyPressEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void place();
  void close();

  QListView& list_;
  CatalogueEditor& editor_;
  ObjectListModel& model_;
  ObjectId object_;
  QString name_before_;
};

}  // namespace scantrove
