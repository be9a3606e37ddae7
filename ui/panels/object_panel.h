#pragma once
#include <QWidget>
#include <vector>

#include "core/base/ids.h"

class QAction;
class QLabel;
class QListView;
class QStackedWidget;

namespace scantrove {

class CatalogueEditor;
class ObjectListModel;
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
  [[nodiscard]] QListView* list() const { return list_; }
  [[nodiscard]] ViewsStrip* viewsStrip() const { return strip_; }
  [[nodiscard]] std::vector<ObjectId> selection() const;
  void selectFirst();

  [[nodiscard]] QSize sizeHint() const override { return {290, 640}; }

 private:
  void makeActions();
  QWidget* makeDetails();
  void editName();
  void toggleConfirmed();
  void updateCounts();
  void updateSelection();

  CatalogueEditor& editor_;
  ObjectListModel& model_;
  Actions actions_{};
  QStackedWidget* pages_;
  QListView* list_;
  QLabel* count_;
  QWidget* details_ = nullptr;
  QLabel* selected_name_ = nullptr;
  ViewsStrip* strip_ = nullptr;
  ObjectId shown_;
  int shown_views_ = -1;
};

}  // namespace scantrove
