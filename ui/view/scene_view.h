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
#include "ui/view/pending_snapshots.h"
#include "ui/view/scene_drawing.h"
#include "ui/view/scene_input.h"
#include "ui/view/scene_pointing.h"

namespace scantrove {

/// The 3D view, which connects Qt and VTK. VTK draws offscreen (SceneDrawing), and the widget shows the last
/// complete picture. SceneInput handles mouse and keys.
class SceneView : public QWidget {
  Q_OBJECT

 public:
  explicit SceneView(QWidget* parent = nullptr);
  ~SceneView() override;

  [[nodiscard]] LabelCloudScene& scene() { return scene_; }
  [[nodiscard]] SceneDrawing& drawing() { return drawing_; }
  [[nodiscard]] SceneInput& input() { return input_; }
  void clearScene();
  /// Adds its bricks a few at a time.
  void showSnapshot(const std::shared_ptr<const ScanSnapshot>& snapshot);
  void setColors(const LabelCloudScene::Colors& colors);

  [[nodiscard]] bool following() const { return scene_.following(); }
  /// Region and point of the last drawing at a position in widget coordinates.
  [[nodiscard]] RegionPoint at(const QPointF& position);
  /// Position of a world point in widget coordinates, even if it is hidden; none: outside of the view.
  [[nodiscard]] std::optional<QPointF> positionOf(const Eigen::Vector3f& point_world);
  /// CV_32SC1: region by pixel of the last drawing, at about half its size.
  [[nodiscard]] const cv::Mat& regionIds();
  void setColoring(Coloring coloring);
  /// Sets the background regions and their style.
  void setBackground(const std::set<RegionId>& regions, BackgroundStyle style);
  /// Sets the selected regions. Unless they are large, they are drawn in fine detail.
  void setSelected(const std::set<RegionId>& regions);
  void lookFrom(StandardView from);
  /// Looks from a camera in its direction.
  void lookFromCamera(const Eigen::Isometry3d& T_world_camera);
  /// Shows all of `box` from the current direction; does nothing if it is empty.
  void fit(const Eigen::AlignedBox3f& box);
  [[nodiscard]] QSize sizeHint() const override { return {900, 640}; }

 public slots:
  void setFollowing(bool following);
  void fitAll();
  /// Turns around the target by `yaw` radians without ending the following of the camera.
  void turn(float yaw);
  void setGridVisible(bool visible);

 signals:
  void followingChanged(bool following);
  void drawn();  ///< the results of at() may have changed
  void pointedAt(const QPointF& position);
  void pointerLeft();
  void clicked(const QPointF& position, Qt::KeyboardModifiers modifiers);
  void doubleClicked(const QPointF& position);
  void menuRequested(const QPointF& position, const QPoint& on_screen);
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
  void transfer();

  LabelCloudScene scene_;
  PendingSnapshots pending_snapshots_{scene_};
  SceneDrawing drawing_{*this, scene_, pending_snapshots_};
  SceneInput input_{*this};
  QTimer transfer_timer_;
  ScenePointing pointing_{scene_};
};

}  // namespace scantrove
