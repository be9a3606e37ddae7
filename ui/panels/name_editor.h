#pragma once
#include <QLineEdit>

#include "core/base/ids.h"
#include "ui/models/object_renamer.h"
#include "ui/models/typed_name.h"

namespace scantrove {

class CatalogueEditor;
class ObjectListModel;
class ObjectListView;
class SameNameChoice;

/// Field for renaming an object of the list, by a name or a class (ObjectRenamer). It belongs to an object,
/// not to a row, so rows may change while the user types. After a merge it renames the merged object. Return
/// or leaving the field stores the name; Escape cancels. If another object has the name, it offers two
/// answers (SameNameChoice). If a name cannot be stored, it stays in the field and CatalogueEditor::failed
/// gives the reason.
class NameEditor : public QLineEdit {
  Q_OBJECT

 public:
  NameEditor(ObjectListView& list, CatalogueEditor& editor, ObjectListModel& model);

  /// If the name of another object could not be stored, its field gets the focus instead.
  void begin(ObjectId object);
  /// Stores the name. False if it could not be stored.
  bool finish(TypedName::Answer answer = TypedName::Answer::another);
  void cancel();
  [[nodiscard]] bool isOpen() const { return bool(object_); }
  [[nodiscard]] SameNameChoice* choice() const { return choice_; }

 protected:
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void place();
  void close();
  void showChoice(const QString& text);

  ObjectListView& list_;
  ObjectListModel& model_;
  ObjectRenamer renamer_;
  SameNameChoice* choice_;
  ObjectId object_;
  QString name_before_;
};

}  // namespace scantrove
