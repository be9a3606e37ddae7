#pragma once
#include <QTimer>
#include <QWidget>

class QAction;
class QComboBox;
class QLineEdit;

namespace scantrove {

class ObjectFilter;
class ObjectListModel;

/// Search field, filter and order of the object list. The filter's entries say how many objects each shows.
class ObjectFilterBar : public QWidget {
  Q_OBJECT

 public:
  /// Both outlive it.
  ObjectFilterBar(ObjectListModel& model, ObjectFilter& filter, QWidget* parent = nullptr);

  [[nodiscard]] QLineEdit* search() const { return search_; }
  [[nodiscard]] QComboBox* shown() const { return shown_; }
  [[nodiscard]] QComboBox* order() const { return order_; }
  /// Ctrl+F: puts the focus into the search field.
  [[nodiscard]] QAction* findAction() const { return find_; }
  /// Shows all objects.
  void clear();
  /// Counts the objects of each entry again.
  void updateEntries();

 signals:
  void changed();     ///< the list shows other objects
  void listWanted();  ///< Return or Down in the search field

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void applyShown();

  ObjectListModel& model_;
  ObjectFilter& filter_;
  QLineEdit* search_;
  QComboBox* shown_;
  QComboBox* order_;
  QAction* find_;
  QTimer counting_;
};

}  // namespace scantrove
