#pragma once
#include <QObject>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

class FramePanels;
class ObjectListModel;
class ObjectPanel;
class RegionSelection;

/// Keeps one selection in list, pictures and 3D view: selected regions select their objects in the list, and
/// objects selected there select their regions.
class SelectionLink : public QObject {
  Q_OBJECT

 public:
  /// All outlive it.
  SelectionLink(RegionSelection& regions, ObjectPanel& objects, FramePanels& frames, QObject* parent);

 private:
  void followList(const std::vector<ObjectId>& objects);
  void followRegions();
  [[nodiscard]] std::vector<ObjectId> objectsOfRegions() const;

  RegionSelection& regions_;
  ObjectPanel& objects_;
  FramePanels& frames_;
  std::vector<ObjectId> of_regions_;  ///< objects of the selected regions, as last seen
  bool is_following_ = false;         ///< one selection is being set from the other
};

}  // namespace scantrove
