#pragma once
#include <Eigen/Core>
#include <QObject>
#include <QString>
#include <QTimer>
#include <map>

#include "core/base/ids.h"

class QAction;

namespace scantrove {

class FramePanels;
class RegionSelection;
class ScenePane;

/// The names of the scan's regions in the 3D view and in the pictures. In 3D a name stands at a visible point
/// of its region and moves with the view; a hidden region has no name there.
class SceneNames : public QObject {
  Q_OBJECT

 public:
  /// All outlive it.
  SceneNames(RegionSelection& selection, ScenePane& scene, FramePanels& frames, QObject* parent);

  /// Shows the names in 3D or not; remembered between runs.
  [[nodiscard]] QAction* action() const { return action_; }
  /// By region, of those that are named and no background.
  [[nodiscard]] const std::map<RegionId, QString>& names() const { return names_; }

 private:
  void updateNames();
  /// Finds visible points of the named regions.
  void findAnchors();
  /// Shows the names where the view has their points now.
  void place();

  RegionSelection& selection_;
  ScenePane& scene_;
  FramePanels& frames_;
  QAction* action_;
  std::map<RegionId, QString> names_;
  std::map<RegionId, Eigen::Vector3f> anchors_world_;
  QTimer find_timer_;
};

}  // namespace scantrove
