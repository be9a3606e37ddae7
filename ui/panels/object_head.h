#pragma once
#include <QLineEdit>
#include <QWidget>
#include <optional>

#include "core/base/ids.h"
#include "core/geometry/view_coverage.h"
#include "ui/models/object_renamer.h"

class QLabel;
class QPushButton;

namespace scantrove {

class CatalogueEditor;
class ObjectListModel;
class SameNameChoice;

/// Name, class, state, size and seen sides of one object. The name is edited as in the list (ObjectRenamer):
/// Return or leaving the field stores it, Escape cancels, and if another object has the name, two answers are
/// offered.
class ObjectHead : public QWidget {
  Q_OBJECT

 public:
  /// Both outlive it.
  ObjectHead(CatalogueEditor& editor, ObjectListModel& model, QWidget* parent = nullptr);

  /// Reads the row of the object again; a name that is being typed stays.
  void showObject(ObjectId object);
  /// None: not known. `text`: in words.
  void showSides(const std::optional<SeenSides>& sides, const QString& text);
  /// Stores the typed name. False if it could not be stored.
  bool finish(TypedName::Answer answer = TypedName::Answer::another);
  [[nodiscard]] QLineEdit* nameField() const { return name_; }
  [[nodiscard]] QPushButton* confirmButton() const { return confirm_; }
  [[nodiscard]] SameNameChoice* choice() const { return choice_; }
  /// "Named", for example.
  [[nodiscard]] QString state() const;

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void cancel();
  void showChoice(const QString& text);
  [[nodiscard]] bool handleKey(const QKeyEvent& key);

  CatalogueEditor& editor_;
  ObjectListModel& model_;
  ObjectRenamer renamer_;
  QLineEdit* name_;
  SameNameChoice* choice_;
  QLabel* class_;
  QLabel* state_;
  QLabel* size_;
  QLabel* ring_;
  QLabel* sides_;
  QPushButton* confirm_;
  ObjectId object_;
  QString name_before_;
};

}  // namespace scantrove
