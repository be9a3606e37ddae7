#pragma once
#include <QElapsedTimer>
#include <QImage>
#include <QObject>
#include <QTimer>
#include <cstddef>
#include <memory>

#include "ui/scene/label_cloud_scene.h"
#include "ui/view/pending_snapshots.h"
#include "ui/view/point_budget.h"

class QPainter;
class QWidget;

namespace scantrove {

class QtRenderWindow;

/// Draws the scene of a view: decides when and in how much detail, and stores the last complete picture.
/// Draws rarely during a scan to leave computing time to it, at once after edits by the user, and coarser
/// while the user turns the view.
class SceneDrawing : public QObject {
  Q_OBJECT

 public:
  /// All of these outlive it. `view` must paint itself with paint().
  SceneDrawing(QWidget& view, LabelCloudScene& scene, PendingSnapshots& pending_snapshots);
  ~SceneDrawing() override;

  /// Call before objects that own OpenGL resources are destroyed.
  void makeCurrent();
  void paint(QPainter& painter);

  /// Draws as soon as the time share of drawing allows.
  void schedule();
  /// Draws after a direct change of the scene. `moving`: further changes follow, so it draws quickly.
  void redraw(bool moving = false);
  /// Draws after a resize of the view; more may follow.
  void redrawResized();
  /// Draws an edit by the user without delay.
  void drawUserEdit();
  /// While true, drawing takes at most about a sixth of the time.
  void setScanning(bool scanning);
  [[nodiscard]] bool isScanning() const { return scanning_; }
  /// Whether the last complete picture has the detail of a view at rest.
  [[nodiscard]] bool isDetailed() const { return is_detailed_; }
  /// Draws everything at full detail regardless of time (for a picture of the window).
  void setFullDetail(bool full) {
    full_detail_ = full;
    is_outdated_ = true;
  }
  /// Call when the user moves the pointer over any view of the scan; delays drawing for a moment.
  void notePointing() { since_pointed_.start(); }

 signals:
  void drawn(const QSize& pixels);

 private:
  /// Kind of the current drawing in parts.
  enum class InParts { none, still, arriving };

  /// If nothing moves: one step of a detailed drawing, which would block the window if done at once. The last
  /// step shows it.
  void drawStill();
  /// While data arrives: one step of preparing new chunks or of drawing. The last step shows the picture.
  void drawArriving();
  void beginParts(InParts what);
  /// Draws a part. False after the last one.
  bool drawPart(const QSize& pixels);
  /// Draws at once, for a paint event.
  void drawNow(const QSize& pixels);
  /// Stores the complete drawing from VTK's framebuffer.
  void takePicture(const QSize& pixels, double took_ms);
  void drawUnlessPointing();
  /// Whether the view moves or data arrives, so that the next drawing follows soon.
  [[nodiscard]] bool drawsQuickly() const;
  [[nodiscard]] PointBudget& budget();
  [[nodiscard]] PointBudget& partBudget();
  /// Prepares the scene for a quick drawing. Rebuilds chunks with about `rebuild_points` points.
  void prepareQuickly(const QSize& pixels, std::size_t rebuild_points);
  [[nodiscard]] QSize pixels() const;
  /// Whether the picture has all details and nearly the view's size.
  [[nodiscard]] bool isStretched() const;

  struct Budgets {
    PointBudget part{25, 1e4, 1e4, 1e5};
    PointBudget arriving_part{16, 1e4, 1e4, 5e4};
    PointBudget moving{45, 6e4, 1e5};
    PointBudget resizing{12, 8e3, 1.5e4};  ///< small, because the whole window is repainted
    PointBudget scanning{40, 8e4, 1.2e5};
    PointBudget still{600, 5e5, 1e6};
  };

  QWidget& view_;
  LabelCloudScene& scene_;
  PendingSnapshots& pending_snapshots_;
  std::unique_ptr<QtRenderWindow> window_;
  QImage picture_;  ///< of the last complete drawing
  QTimer draw_timer_;
  QTimer settle_timer_;  ///< draws in full detail after the last movement
  QElapsedTimer since_draw_, since_pointed_;
  bool is_outdated_ = true;     ///< the picture
  bool is_detailed_ = false;    ///< the picture
  bool is_prepared_ = false;    ///< for the next picture
  int preparing_steps_ = 0;     ///< preparation steps done for it
  bool is_complete_ = false;    ///< all chunks in view are up to date
  bool has_user_edit_ = false;  ///< an edit by the user is not drawn yet
  InParts in_parts_ = InParts::none;
  double parts_ms_ = 0;  ///< time of the current drawing in parts
  double draw_ms_ = 30;  ///< smoothed time of drawing
  Budgets budgets_;
  bool scanning_ = false;
  bool moving_ = false;
  bool resizing_ = false;  ///< implies moving_
  bool full_detail_ = false;
};

}  // namespace scantrove
