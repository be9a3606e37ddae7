#pragma once
#include <Eigen/Geometry>
#include <QObject>
#include <QPoint>
#include <QPointF>
#include <functional>
#include <memory>

#include "core/scan/scan_snapshot.h"
#include "ui/bridge/scan_bridge.h"
#include "ui/common/region_point.h"
#include "ui/panels/frame_pointing.h"

class QAction;
class QWidget;

namespace scantrove {

class FramePanels;
class ImagePage;
class PaintController;
class RegionSelection;

/// Shows a picture of the current frame in the main area, in place of the 3D view or beside it. In a key
/// frame of an open session it has the masks at full resolution, which can be painted.
class ImageMode : public QObject {
  Q_OBJECT

 public:
  struct Parts {
    ScanBridge& bridge;
    ImagePage& page;
    FramePanels& frames;
    QWidget& scene;  ///< the 3D view
    RegionSelection& selection;
    QAction& action;  ///< switches the mode
  };
  /// All parts outlive it. Connect after what shows snapshots in `frames`.
  ImageMode(const Parts& parts, QObject* parent);

  [[nodiscard]] bool isActive() const;
  [[nodiscard]] ImagePage& page() const { return parts_.page; }
  [[nodiscard]] PaintController& painting() const { return *painting_; }
  void setTag(const QStringList& tag);

 signals:
  void pointedAt(const scantrove::RegionPoint& point);
  void pointerLeft();
  void clicked(const scantrove::RegionPoint& point, Qt::KeyboardModifiers modifiers);
  void doubleClicked(const scantrove::RegionPoint& point, const QPoint& on_screen);
  void menuRequested(const scantrove::RegionPoint& point, const QPoint& on_screen);
  /// A stroke is complete: an edit of the scan.
  void operationReady(const scantrove::Operation& operation);
  void failed(const QString& message);
  /// The 3D view stands beside the image and should show what the camera sees.
  void cameraShown(const Eigen::Isometry3d& T_world_camera);

 private:
  void connectScan();
  void connectCanvas();
  void connectBars();
  void setActive(bool active);
  void showSnapshot(const ScanSnapshot& snapshot);
  void requestLabels();
  void noteEdit(const ScanEdit& edit);
  void refresh();
  void refreshNames();
  void refreshHighlight();
  void showDraft(const QRect& changed);
  void showCamera();
  void updateTool();
  void press(const QPointF& at);
  void release(const QPointF& at, Qt::KeyboardModifiers modifiers);

  /// Whether the shown picture has the pixels of the masks.
  [[nodiscard]] bool isPaintable() const;
  [[nodiscard]] FramePointing::Picture kind() const;
  [[nodiscard]] cv::Mat shownRegions() const;
  [[nodiscard]] QImage comparedPicture() const;
  [[nodiscard]] RegionPoint pointAt(const QPointF& at) const;

  Parts parts_;
  PaintController* painting_;
  int shown_key_frame_ = -1;  ///< as in the snapshot
  Eigen::Isometry3d T_world_camera_ = Eigen::Isometry3d::Identity();
  QSize size_;  ///< of the image whose pixels the canvas counts
};

}  // namespace scantrove
