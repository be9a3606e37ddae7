#pragma once
#include <QElapsedTimer>
#include <QObject>
#include <map>
#include <memory>
#include <optional>

#include "core/scan/scan_snapshot.h"

class QAction;

namespace scantrove {

class ObjectListModel;
class RegionSelection;
class ScenePane;

/// Tells a person who collects objects from which sides they were seen: the objects' rings in the list, and
/// for what is selected a ring in the 3D view, and an arrow around it to where to look from next.
class CoverageGuide : public QObject {
  Q_OBJECT

 public:
  /// All of these outlive the guide.
  CoverageGuide(RegionSelection& selection, ScenePane& scene, ObjectListModel& objects, QObject* parent);

  void beginScan();
  void showSnapshot(const ScanSnapshot& snapshot);

  /// Whether the arrow is shown; remembered.
  [[nodiscard]] QAction* action() const { return action_; }
  /// Of what is selected; none: nothing is, or it is no thing that one would collect.
  [[nodiscard]] const std::optional<SeenSides>& shown() const { return shown_; }
  /// Where the arrow leads, from the middle of what is selected (unit, world); none: there is no arrow.
  [[nodiscard]] const std::optional<Eigen::Vector3f>& leadsTo() const { return leads_to_; }

 private:
  void update();
  void showObjects();
  void showArrow(const SeenSides& seen);
  void findBox();
  void placeLabel();

  RegionSelection& selection_;
  ScenePane& scene_;
  ObjectListModel& objects_;
  QAction* action_;
  std::map<ObjectId, ViewCoverage> objects_seen_from_;  ///< as the list shows it
  std::map<ObjectId, SeenSides> sides_of_objects_;
  SideAxes axes_of_objects_;
  Eigen::AlignedBox3f box_;                ///< of what is selected
  QElapsedTimer since_box_;                ///< was found; not valid: it is of something else
  std::optional<Eigen::Vector3f> camera_;  ///< centre, world; none: there is none to be moved
  std::optional<SeenSides> shown_;
  std::optional<Eigen::Vector3f> leads_to_;
  Eigen::Vector3f head_ = Eigen::Vector3f::Zero();  ///< of the arrow, world
};

}  // namespace scantrove
