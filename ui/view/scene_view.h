#pragma once
#include <QElapsedTimer>
#include <QImage>
#include <QTimer>
#include <QWidget>
#include <memory>
#include <optional>

#include <opencv2/core/mat.hpp>
#include <set>

#include "core/scan/scan_snapshot.h"
#include "ui/common/region_point.h"
#include "ui/models/stroke_path.h"
#include "ui/scene/label_cloud_scene.h"
#include "ui/view/point_budget.h"
#include "ui/view/scene_pointing.h"
#include "ui/view/snapshot_arrivals.h"

namespace scantrove {

class QtRenderWindow;

/// The 3D view: the one place where Qt and VTK meet. VTK draws out of sight, and the widget shows the picture
/// of the last drawing that is complete. Draws seldom while a scan runs, so that most of the machine
/// stays with the scan, at once what a person did to the regions, and coarser while the person turns the
/// view.
///
/// Left drag turns, middle or Shift+left drag moves, right drag or wheel zooms, Ctrl+left drag draws a band;
/// arrow keys, + and - and Home do the same from the keyboard. What is pointed at and clicked is told.
class SceneView : public QWidget {
  Q_OBJECT

 public:
  explicit SceneView(QWidget* parent = nullptr);
  ~SceneView() override;

  [[nodiscard]] LabelCloudScene& scene() { return scene_; }
  void clearScene();
  /// Its bricks come into view a few at a time.
  void showSnapshot(const std::shared_ptr<const ScanSnapshot>& snapshot);
  /// While true, drawing takes about a sixth of the time at most.
  void setScanning(bool scanning);
  void setColors(const LabelCloudScene::Colors& colors);

  [[nodiscard]] bool following() const { return scene_.following(); }
  /// Draws everything at full detail, however long it takes (for a picture of the window).
  void setFullDetail(bool full) {
    full_detail_ = full;
    is_old_ = true;
  }
  /// A person moves the pointer over what the scan shows, here or elsewhere: drawing waits for a moment.
  void notePointing() { since_pointed_.start(); }

  /// What the last drawing shows there. Widget coordinates.
  [[nodiscard]] RegionPoint at(const QPointF& place);
  /// Where a point of the world is seen, hidden or not. Widget coordinates; none: not in the view.
  [[nodiscard]] std::optional<QPointF> placeOf(const Eigen::Vector3f& point_world);
  /// CV_32SC1: the region in each pixel of the last drawing, at about half its size.
  [[nodiscard]] const cv::Mat& regionIds();
  /// While on, a left drag that begins on a region draws a stroke, and strokeAt() says what lies under it;
  /// one that begins beside everything turns the view as ever. Turned off, a stroke on its way is given up.
  void setDrawsStrokes(bool draws);
  /// What is being drawn, widget coordinates; empty: nothing is.
  [[nodiscard]] const QPolygonF& stroke() const { return stroke_.places(); }
  /// Of the band that is being drawn, widget coordinates; empty: none is.
  [[nodiscard]] QRectF band() const;
  void setColoring(Coloring coloring);
  /// These regions are background and look like that from now on.
  void setBackground(const std::set<RegionId>& regions, BackgroundStyle look);
  /// These are selected: as long as they are small they are drawn finely, whatever arrives.
  void setSelected(const std::set<RegionId>& regions);
  void lookFrom(StandardView from);
  /// Looks at all of `box` from the present direction; an empty one changes nothing.
  void fit(const Eigen::AlignedBox3f& box);
  /// The scene was changed directly. `moving`: it will soon be again, so draw quickly.
  void redraw(bool moving = false);

  [[nodiscard]] QSize sizeHint() const override { return {900, 640}; }

 public slots:
  void setFollowing(bool following);
  void fitAll();
  /// Around what is looked at, in radians; as if nobody had touched it.
  void turn(float yaw);
  void setGridVisible(bool visible);

 signals:
  void followingChanged(bool following);
  void drawn();  ///< what places show may be something else now
  void pointedAt(const QPointF& place);
  void pointerLeft();
  void clicked(const QPointF& place, Qt::KeyboardModifiers modifiers);
  void doubleClicked(const QPointF& place);
  void menuRequested(const QPointF& place, const QPoint& on_screen);
  void bandChanged();
  void bandDrawn(const QRectF& band);
  void strokeAt(const scantrove::RegionPoint& point);
  void strokeChanged();
  void strokeEnded(Qt::KeyboardModifiers modifiers);
  void cleared();

 protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  /// What is being drawn in VTK's framebuffer, a part at a time.
  enum class InParts { none, still, arriving };

  /// Draws as soon as the share of time allows.
  void schedule();
  void interacted();
  void takeOver();
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
  void beginStroke(const QMouseEvent& event);
  void drawStroke(const QPointF& to);

  LabelCloudScene scene_;
  SnapshotArrivals arrivals_{scene_};
  std::unique_ptr<QtRenderWindow> window_;
  QImage picture_;  ///< of the last complete drawing
  QTimer draw_timer_;
  QTimer arrival_timer_;
  QTimer settle_timer_;  ///< after the last movement: back to full detail
  QElapsedTimer since_draw_, since_pointed_;
  bool is_old_ = true;                      ///< what was drawn
  bool is_prepared_ = false;                ///< the next picture
  int preparing_steps_ = 0;                 ///< that were made for it
  bool is_complete_ = false;                ///< nothing is to be made ready for more of them
  bool is_awaited_ = false;                 ///< what a person did is not drawn yet
  QPointF last_mouse_;                      ///< on the screen
  std::optional<QPointF> press_, band_to_;  ///< in the widget
  bool is_dragged_ = false;                 ///< since the press
  bool is_given_up_ = false;                ///< the stroke of this press: the rest of the drag does nothing
  bool draws_strokes_ = false;
  StrokePath stroke_;
  ScenePointing pointing_{scene_};
  InParts in_parts_ = InParts::none;
  double parts_ms_ = 0;  ///< what the drawing in parts took so far
  double draw_ms_ = 30;  ///< smoothed time of drawing
  PointBudget part_budget_{25, 1e4, 1e4, 1e5};
  PointBudget arriving_part_budget_{16, 1e4, 1e4, 5e4};
  PointBudget moving_budget_{45, 6e4, 1e5};
  PointBudget resizing_budget_{12, 8e3, 1.5e4};  ///< all the window is drawn anew then
  PointBudget scanning_budget_{40, 8e4, 1.2e5};
  PointBudget still_budget_{600, 5e5, 1e6};
  bool scanning_ = false;
  bool moving_ = false;
  bool resizing_ = false;  ///< so it moves
  bool full_detail_ = false;
};

}  // namespace scantrove
