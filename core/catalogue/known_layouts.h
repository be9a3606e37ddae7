#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// Where the objects of earlier scans stood among each other. When a scan has recognised some that stand to
/// each other as they did then, it is in the same place, and what else stood there is to be expected where it
/// stood: with that, less likeness is enough to know it again. Each session has a world of its own.
class KnownLayouts {
 public:
  struct ObjectPosition {
    ObjectId object;
    Eigen::Vector3f centroid_world;
  };
  /// Who holds what was that object's; none: nobody.
  using MergeRootOf = std::function<ObjectId(ObjectId)>;

  static constexpr int kFewest = 3;       ///< objects that must stand as they did, and a third of all
  static constexpr float kNear_m = 0.1F;  ///< from where they stood, all moved as one
  /// What is expected may stand so far from there: maps bend, and the far ones are off by more.
  static constexpr float kExpected_m = 0.15F;

  /// In that session's world a view of the object saw it there.
  void add(std::int64_t session, ObjectId object, const Eigen::Vector3f& centroid_world);

  /// Finds the sessions in whose places these objects, which the scan has recognised and which hold their own
  /// views, stand as they did. Milliseconds at most: a few dozen are enough.
  void align(const std::vector<ObjectPosition>& recognized, const MergeRootOf& merge_root_of);

  /// Who holds the objects that stood there when earlier scans saw the place, nearest first.
  [[nodiscard]] std::vector<ObjectId> expectedAt(const Eigen::Vector3f& centroid_world) const;

 private:
  struct Sightings {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    Eigen::Vector3f least = Eigen::Vector3f::Zero(), most = Eigen::Vector3f::Zero();
    int count = 0;
    /// It was put elsewhere while that session saw it.
    [[nodiscard]] bool haveMoved() const { return (most - least).norm() > 2 * kNear_m; }
    [[nodiscard]] Eigen::Vector3f mean() const { return sum / static_cast<float>(count); }
  };
  std::map<std::int64_t, std::map<ObjectId, Sightings>> sessions_;
  std::vector<ObjectPosition> expected_;  // in this scan's world
};

}  // namespace scantrove
