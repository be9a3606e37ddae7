#pragma once
#include <QLineEdit>

#include "core/base/ids.h"

class QListView;

namespace scantrove {

class CatalogueEditor;
class ObjectListModel;

/// The field in which an object of the list gets another name. It belongs to an object and not to a row: rows
/// may come, go and change while a person types, and what was typed stays and goes to that object, or to the
/// one that holds it after a merge. Return and leaving the field store the name, Escape gives it up. A name
/// that cannot be stored stays in the field, and CatalogueEditor::failed says why.
class NameEditor : public QLineEdit {
  Q_OBJECT

 public:
  NameEditor(QListView& list, CatalogueEditor& editor, ObjectListModel& model);

  /// Not while another name waits that could not be stored; that one gets the focus instead.
  void begin(ObjectId object);
  /// True when no name waits any more.
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
