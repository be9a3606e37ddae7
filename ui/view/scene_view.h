#pragma once
#include <QTimer>
#include <QWidget>
#include <memory>
#include <optional>

#include <opencv2/core/mat.hpp>
#include <set>

#include "core/scan/scan_snapshot.h"
#include "ui/common/region_point.h"
#include "ui/scene/label_cloud_scene.h"
#include "ui/view/scene_drawing.h"
#include "ui/view/scene_input.h"
#include "ui/view/scene_pointing.h"
#include "ui/view/snapshot_arrivals.h"

namespace scantrove {

/// The 3D view: the one place where Qt and VTK meet. VTK draws out of sight (SceneDrawing), and the widget
/// shows the picture of the last drawing that is complete. SceneInput takes mouse and keys.
class SceneView : public QWidget {
  Q_OBJECT

 public:
  explicit SceneView(QWidget* parent = nullptr);
  ~SceneView() override;

  [[nodiscard]] LabelCloudScene& scene() { return scene_; }
  [[nodiscard]] SceneDrawing& drawing() { return drawing_; }
  [[nodiscard]] SceneInput& input() { return input_; }
  void clearScene();
  /// Its bricks come into view a few at a time.
  void showSnapshot(const std::shared_ptr<const ScanSnapshot>& snapshot);
  void setColors(const LabelCloudScene::Colors& colors);

  [[nodiscard]] bool following() const { return scene_.following(); }
  /// What the last drawing shows there. Widget coordinates.
  [[nodiscard]] RegionPoint at(const QPointF& place);
  /// Where a point of the world is seen, hidden or not. Widget coordinates; none: not in the view.
  [[nodiscard]] std::optional<QPointF> placeOf(const Eigen::Vector3f& point_world);
  /// CV_32SC1: the region in each pixel of the last drawing, at about half its size.
  [[nodiscard]] const cv::Mat& regionIds();
  void setColoring(Coloring coloring);
  /// These regions are background and look like that from now on.
  void setBackground(const std::set<RegionId>& regions, BackgroundStyle style);
  /// These are selected: as long as they are small they are drawn finely, whatever arrives.
  void setSelected(const std::set<RegionId>& regions);
  void lookFrom(StandardView from);
  /// Looks at all of `box` from the present direction; an empty one changes nothing.
  void fit(const Eigen::AlignedBox3f& box);
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

 private:
  void takeOver();

  LabelCloudScene scene_;
  SnapshotArrivals arrivals_{scene_};
  SceneDrawing drawing_{*this, scene_, arrivals_};
  SceneInput input_{*this};
  QTimer arrival_timer_;
  ScenePointing pointing_{scene_};
};

}  // namespace scantrove
