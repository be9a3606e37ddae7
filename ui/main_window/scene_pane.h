#pragma once
#include <QWidget>

#include "ui/view/scene_view.h"

class QAction;
class QFrame;

namespace scantrove {

class SceneOverlay;
class ViewActions;

/// The 3D view with floating buttons in a corner.
class ScenePane : public QWidget {
  Q_OBJECT

 public:
  explicit ScenePane(QWidget* parent = nullptr);

  [[nodiscard]] SceneView* view() const { return view_; }
  [[nodiscard]] SceneOverlay* overlay() const { return overlay_; }
  [[nodiscard]] QAction* followAction() const { return follow_; }
  [[nodiscard]] QAction* fitAction() const { return fit_; }
  [[nodiscard]] QAction* gridAction() const { return grid_; }
  /// Actions for the display of the scene.
  [[nodiscard]] ViewActions* viewActions() const { return view_actions_; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void paintTheme();

  SceneView* view_;
  SceneOverlay* overlay_;
  QFrame* buttons_;
  QAction* follow_;
  QAction* fit_;
  QAction* grid_;
  ViewActions* view_actions_;
};

}  // namespace scantrove
