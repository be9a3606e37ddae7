#pragma once
#include <QObject>
#include <QTimer>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

#include "core/base/ids.h"
#include "core/catalogue/catalogue_change.h"
#include "core/collection/shape_change.h"

namespace scantrove {

class MainWindow;

/// Notices when the regions of a confirmed object are no longer what the user confirmed (changeOf()), and
/// marks it in the list. What was confirmed is what the scan had of the object at that moment, or when the
/// finished scan was opened. It is known while the scan is open.
class ShapeWatch : public QObject {
  Q_OBJECT

 public:
  /// Call after the window's parts were created.
  explicit ShapeWatch(MainWindow& window);

  /// These objects are right as they are now.
  void accept(const std::vector<ObjectId>& objects);

 private:
  /// What the scan has of an object.
  struct State {
    std::set<RegionId> regions;
    std::int64_t voxels = 0;
  };
  struct Watched {
    RegionAppearance confirmed;
    RegionAppearance now;
    State checked;  ///< that `now` is of
  };

  void clear();
  void follow(const CatalogueChanges& changes);
  void schedule();
  void check();
  void showChanges();
  [[nodiscard]] std::map<ObjectId, State> statesOfConfirmed() const;
  /// Whether the object has enough other voxels, or other regions, to look at them again.
  [[nodiscard]] bool differs(ObjectId object, const State& state) const;

  MainWindow& window_;
  std::map<ObjectId, Watched> watched_;
  std::set<ObjectId> to_begin_;  ///< confirmed in this scan, and not looked at yet
  bool is_review_ = false;       ///< the scan has ended: all its confirmed objects are watched
  std::size_t points_ = 0;       ///< of the 3D view, at the last check
  QTimer timer_;
};

}  // namespace scantrove
