#pragma once
#include <QObject>
#include <set>

#include "core/base/ids.h"
#include "ui/scene/cloud_style.h"

class QAction;
class QActionGroup;
class QMenu;
class QToolButton;

namespace scantrove {

class ClipTool;
class MeasureTool;
class SceneView;

/// Actions for the display of the 3D view, with keys. Colour mode and background style are stored between
/// runs.
class ViewActions : public QObject {
  Q_OBJECT

 public:
  ViewActions(SceneView* view, QObject* parent);

  void addTo(QMenu* menu);
  /// A button with a menu of colour modes.
  [[nodiscard]] QToolButton* makeColoringButton();

  /// Sets the background regions.
  void setBackground(const std::set<RegionId>& regions);
  [[nodiscard]] Coloring coloring() const { return coloring_; }

  /// One action per Coloring, in its order.
  [[nodiscard]] QList<QAction*> coloringActions() const;
  [[nodiscard]] QAction* backgroundAction() const { return background_action_; }
  [[nodiscard]] QAction* clipAction() const { return clip_action_; }
  [[nodiscard]] QAction* measureAction() const { return measure_action_; }
  [[nodiscard]] MeasureTool* measureTool() const { return measure_; }

 private:
  void makeColorings();
  void makeStandardViews();
  void color(Coloring coloring);
  void setBackgroundStyle(BackgroundStyle style);

  SceneView* view_;
  ClipTool* clip_;
  MeasureTool* measure_;
  QActionGroup* colorings_;
  QAction* next_coloring_;
  QList<QAction*> standard_views_;
  QAction* background_action_;
  QAction* clip_action_;
  QAction* measure_action_;
  std::set<RegionId> background_;
  BackgroundStyle background_style_ = BackgroundStyle::as_others;
  Coloring coloring_ = Coloring::regions;
};

}  // namespace scantrove
