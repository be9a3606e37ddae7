#pragma once
#include <QElapsedTimer>
#include <QImage>
#include <QObject>
#include <QTimer>
#include <cstddef>
#include <memory>

#include "ui/scene/label_cloud_scene.h"
#include "ui/view/point_budget.h"
#include "ui/view/snapshot_arrivals.h"

class QPainter;
class QWidget;

namespace scantrove {

class QtRenderWindow;

/// Draws the scene of a view: decides when and how much of it, and keeps the picture of the last drawing that
/// is complete. Draws seldom while a scan runs, so that most of the machine stays with the scan, at once what
/// a person did to the regions, and coarser while the person turns the view.
class SceneDrawing : public QObject {
  Q_OBJECT

 public:
  /// All of these outlive it. `view` is painted by paint().
  SceneDrawing(QWidget& view, LabelCloudScene& scene, SnapshotArrivals& arrivals);
  ~SceneDrawing() override;

  /// Before anything that OpenGL objects hang on is freed.
  void makeCurrent();
  void paint(QPainter& painter);

  /// Draws as soon as the share of time allows.
  void schedule();
  /// The scene was changed directly. `moving`: it will soon be again, so draw quickly.
  void redraw(bool moving = false);
  /// The view has another size, and may soon have yet another.
  void redrawResized();
  /// Draws what a person did without delay.
  void drawAwaited();
  /// While true, drawing takes about a sixth of the time at most.
  void setScanning(bool scanning);
  [[nodiscard]] bool isScanning() const { return scanning_; }
  /// Draws everything at full detail, however long it takes (for a picture of the window).
  void setFullDetail(bool full) {
    full_detail_ = full;
    is_old_ = true;
  }
  /// A person moves the pointer over what the scan shows, here or elsewhere: drawing waits for a moment.
  void notePointing() { since_pointed_.start(); }

 signals:
  void drawn(const QSize& pixels);

 private:
  /// What is being drawn in VTK's framebuffer, a part at a time.
  enum class InParts { none, still, arriving };

  /// When nothing moves: a step of a drawing with much detail, which would hold the window up if it were made
  /// at once. The last one shows it.
  void drawStill();
  /// While something comes in, likewise: a step of what is new, then the picture, then, in an event of its
  /// own again, the window with it.
  void drawArriving();
  void beginParts(InParts what);
  /// False: that was the last one.
  bool drawPart(const QSize& pixels);
  /// At once, for a paint event.
  void drawNow(const QSize& pixels);
  /// What VTK's framebuffer holds is complete.
  void takePicture(const QSize& pixels, double took_ms);
  void drawUnlessPointing();
  /// Something moves or comes: what is drawn will be drawn anew soon.
  [[nodiscard]] bool hurries() const;
  [[nodiscard]] PointBudget& budget();
  [[nodiscard]] PointBudget& partBudget();
  /// The next picture's points, as many as may be drawn in a hurry.
  /// `rebuild_points`: of those that changed, as many as are made ready.
  void prepareHastily(const QSize& pixels, std::size_t rebuild_points);
  [[nodiscard]] QSize pixels() const;

  struct Budgets {
    PointBudget part{25, 1e4, 1e4, 1e5};
    PointBudget arriving_part{16, 1e4, 1e4, 5e4};
    PointBudget moving{45, 6e4, 1e5};
    PointBudget resizing{12, 8e3, 1.5e4};  ///< all the window is drawn anew then
    PointBudget scanning{40, 8e4, 1.2e5};
    PointBudget still{600, 5e5, 1e6};
  };

  QWidget& view_;
  LabelCloudScene& scene_;
  SnapshotArrivals& arrivals_;
  std::unique_ptr<QtRenderWindow> window_;
  QImage picture_;  ///< of the last complete drawing
  QTimer draw_timer_;
  QTimer settle_timer_;  ///< after the last movement: back to full detail
  QElapsedTimer since_draw_, since_pointed_;
  bool is_old_ = true;        ///< what was drawn
  bool is_prepared_ = false;  ///< the next picture
  int preparing_steps_ = 0;   ///< that were made for it
  bool is_complete_ = false;  ///< nothing is to be made ready for more of them
  bool is_awaited_ = false;   ///< what a person did is not drawn yet
  InParts in_parts_ = InParts::none;
  double parts_ms_ = 0;  ///< what the drawing in parts took so far
  double draw_ms_ = 30;  ///< smoothed time of drawing
  Budgets budgets_;
  bool scanning_ = false;
  bool moving_ = false;
  bool resizing_ = false;  ///< so it moves
  bool full_detail_ = false;
};

}  // namespace scantrove
