#pragma once
#include <QElapsedTimer>
#include <QObject>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/scan/scan_snapshot.h"

class QAction;

namespace scantrove {

class ObjectListModel;
class RegionSelection;
class ScenePane;

/// Shows the user from which sides objects were seen: rings in the object list, a ring for the selection in
/// the 3D view, and an arrow to the next viewpoint. Where one object alone is scanned, it needs no selection.
class CoverageGuide : public QObject {
  Q_OBJECT

 public:
  /// All of these outlive the guide.
  CoverageGuide(RegionSelection& selection, ScenePane& scene, ObjectListModel& objects, QObject* parent);

  /// `is_one_object`: ScanRequest::object.
  void beginScan(bool is_one_object);
  void showSnapshot(const ScanSnapshot& snapshot);

  /// Switches the arrow; stored between runs.
  [[nodiscard]] QAction* action() const { return action_; }
  /// Seen sides of the selection; none if nothing, background or a rejected region is selected.
  [[nodiscard]] const std::optional<SeenSides>& shown() const { return shown_; }
  /// Direction (unit, world) from the middle of the selection to the arrow's target; none: no arrow.
  [[nodiscard]] const std::optional<Eigen::Vector3f>& targetDirection() const { return target_direction_; }

 private:
  /// The selection or, in a scan of one object without a selection, that object.
  [[nodiscard]] std::vector<RegionId> guided() const;
  void update();
  void showObjects();
  void showArrow(const SeenSides& seen);
  void findBox();
  void placeLabel();

  RegionSelection& selection_;
  ScenePane& scene_;
  ObjectListModel& objects_;
  QAction* action_;
  std::map<ObjectId, ViewCoverage> objects_seen_from_;  ///< as shown in the list
  std::map<ObjectId, SeenSides> sides_of_objects_;
  SideAxes axes_of_objects_;
  Eigen::AlignedBox3f box_;                ///< of the selection
  QElapsedTimer since_box_;                ///< since box_ was computed; invalid: the selection changed
  bool is_one_object_ = false;             ///< the scan is of one object alone
  std::optional<Eigen::Vector3f> camera_;  ///< position, world; none: no camera that can move
  std::optional<SeenSides> shown_;
  std::optional<Eigen::Vector3f> target_direction_;
  Eigen::Vector3f head_ = Eigen::Vector3f::Zero();  ///< of the arrow, world
};

}  // namespace scantrove
