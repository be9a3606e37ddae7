#pragma once
#include <QDialog>
#include <QTimer>
#include <optional>
#include <vector>

#include "ui/models/class_editor.h"

class QLabel;
class QPushButton;
class QTableWidget;
class QTableWidgetItem;

namespace scantrove {

class CatalogueEditor;

/// The classes of the catalogue: id, colour, name, supercategory, attributes and number of objects. Cells are
/// edited in place; a double click on a colour changes it. Does not block the window.
class ClassDialog : public QDialog {
  Q_OBJECT

 public:
  /// `editor` outlives it.
  explicit ClassDialog(CatalogueEditor& editor, QWidget* parent = nullptr);

  enum Column { kId, kColor, kName, kSupercategory, kAttributes, kObjects };

  [[nodiscard]] QTableWidget* table() const { return table_; }
  /// What the last import or export did; empty: nothing yet.
  [[nodiscard]] QString message() const;
  /// Of the selected rows, top first.
  [[nodiscard]] std::vector<ClassId> selection() const;
  /// The selected classes become the current one.
  void mergeSelected();
  void hideSelected();
  void importFrom(const QString& file);
  void exportTo(const QString& file);

 protected:
  void showEvent(QShowEvent* event) override;

 private:
  QWidget* makeButtons();
  void readClasses();
  void fillRow(int row);
  void edited(const QTableWidgetItem& item);
  void chooseColor(int row);
  void updateButtons();
  [[nodiscard]] const ListedClass* classAt(int row) const;

  ClassEditor editor_;
  std::vector<ListedClass> classes_;
  QTableWidget* table_;
  QLabel* message_;
  QPushButton* merge_ = nullptr;
  QPushButton* hide_ = nullptr;
  bool is_filling_ = false;
  QTimer update_timer_;
};

}  // namespace scantrove
