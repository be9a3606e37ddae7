#pragma once
#include <QWidget>
#include <vector>

#include "core/base/ids.h"

class QAction;
class QMenu;
class QStackedWidget;
class QToolButton;

namespace scantrove {

class CatalogueEditor;
class ElidedLabel;
class ObjectListModel;
class ObjectListView;
class ViewsStrip;

/// The catalogue: the list of objects, and below it the views of the selected one.
class ObjectPanel : public QWidget {
  Q_OBJECT

 public:
  ObjectPanel(CatalogueEditor& editor, ObjectListModel& model, QWidget* parent = nullptr);

  /// What can be done with the selection; with their keys, which work while the list has the focus.
  struct Actions {
    QAction* rename;
    QAction* confirm;
    QAction* merge;
    QAction* remove;
  };
  [[nodiscard]] const Actions& actions() const { return actions_; }
  [[nodiscard]] ObjectListView* list() const { return list_; }
  /// The file whose objects are listed, as it is shown above them.
  [[nodiscard]] const ElidedLabel* catalogueLabel() const { return catalogue_; }
  [[nodiscard]] ViewsStrip* viewsStrip() const { return strip_; }

  [[nodiscard]] QSize sizeHint() const override { return {290, 640}; }

 public slots:
  /// Enables and words the actions for what is selected now. While a menu is open they stay as it shows them.
  void updateActions();

 signals:
  void selectionChanged(const std::vector<scantrove::ObjectId>& objects);

 private:
  QWidget* makeHead();
  void makeActions();
  QWidget* makeDetails();
  void updateCatalogue();
  void updateCounts();
  void updateSelection();

  CatalogueEditor& editor_;
  ObjectListModel& model_;
  Actions actions_{};
  bool confirms_ = true;  ///< what the action of that name would do; else it takes back
  QStackedWidget* pages_;
  ObjectListView* list_;
  QMenu* menu_;
  ElidedLabel* catalogue_ = nullptr;
  ElidedLabel* count_ = nullptr;
  QToolButton* to_newest_ = nullptr;
  QWidget* details_ = nullptr;
  ElidedLabel* selected_name_ = nullptr;
  ViewsStrip* strip_ = nullptr;
  std::vector<ObjectId> selected_;
  ObjectId shown_;
  int shown_views_ = -1;
};

}  // namespace scantrove
