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
class ObjectFilterBar;
class ObjectListModel;
class ObjectListView;
class ViewsStrip;

/// The catalogue: the list of objects with search, filter and order, and below it the views of the selected
/// one.
class ObjectPanel : public QWidget {
  Q_OBJECT

 public:
  ObjectPanel(CatalogueEditor& editor, ObjectListModel& model, QWidget* parent = nullptr);

  /// Actions on the selection. Their keys work while the list has the focus.
  struct Actions {
    QAction* page;
    QAction* rename;
    QAction* confirm;
    QAction* merge;
    QAction* remove;
  };
  [[nodiscard]] const Actions& actions() const { return actions_; }
  [[nodiscard]] ObjectListView* list() const { return list_; }
  [[nodiscard]] ObjectFilterBar* filterBar() const { return filter_bar_; }
  /// "7 of 19 named", and how many are confirmed.
  [[nodiscard]] const ElidedLabel* countLabel() const { return count_; }
  /// Label with the file of the catalogue, above the list.
  [[nodiscard]] const ElidedLabel* catalogueLabel() const { return catalogue_; }
  [[nodiscard]] ViewsStrip* viewsStrip() const { return strip_; }

  [[nodiscard]] QSize sizeHint() const override { return {290, 640}; }

 public slots:
  /// Updates state and texts of the actions for the selection. They do not change while a menu is open.
  void updateActions();

 signals:
  void selectionChanged(const std::vector<scantrove::ObjectId>& objects);
  void pageRequested(scantrove::ObjectId object);
  void confirmed(const std::vector<scantrove::ObjectId>& objects);  ///< as they are now

 private:
  QWidget* makeHead();
  void makeActions();
  QWidget* makeDetails();
  void connectFilter();
  void updateCatalogue();
  void updateCounts();
  void updateSelection();

  CatalogueEditor& editor_;
  ObjectListModel& model_;
  Actions actions_{};
  bool confirms_ = true;  ///< whether the action confirms, or confirms anew; else it unconfirms
  QStackedWidget* pages_;
  ObjectListView* list_;
  QMenu* menu_;
  ObjectFilterBar* filter_bar_;
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
