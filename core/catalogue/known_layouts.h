#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// The layouts of objects in earlier scans. If recognised objects are arranged as in an earlier scan, the
/// place is the same. Other objects of that scan are then expected at their former positions, where less
/// similarity is enough. Each session has its own world frame.
class KnownLayouts {
 public:
  struct ObjectPosition {
    ObjectId object;
    Eigen::Vector3f centroid_world;
  };
  /// The current owner of an object's views; none: nobody.
  using MergeRootOf = std::function<ObjectId(ObjectId)>;

  static constexpr int kMinObjects = 3;   ///< objects in their former layout, and a third of all
  static constexpr float kNear_m = 0.1F;  ///< maximum offset after one rigid motion
  /// Maximum distance of an expected object: maps bend, so the error grows with distance.
  static constexpr float kExpected_m = 0.15F;

  /// A view of that session saw the object there, in the session's world.
  void add(std::int64_t session, ObjectId object, const Eigen::Vector3f& centroid_world);

  /// Finds sessions in which the recognised objects, which are merge roots, are arranged as now. Takes
  /// milliseconds: a few dozen objects are enough.
  void align(const std::vector<ObjectPosition>& recognized, const MergeRootOf& merge_root_of);

  /// Merge roots of the objects that earlier scans saw at this position, nearest first.
  [[nodiscard]] std::vector<ObjectId> expectedAt(const Eigen::Vector3f& centroid_world) const;

 private:
  struct Sightings {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    Eigen::Vector3f least = Eigen::Vector3f::Zero(), most = Eigen::Vector3f::Zero();
    int count = 0;
    /// Whether the object moved during that session.
    [[nodiscard]] bool haveMoved() const { return (most - least).norm() > 2 * kNear_m; }
    [[nodiscard]] Eigen::Vector3f mean() const { return sum / static_cast<float>(count); }
  };
  std::map<std::int64_t, std::map<ObjectId, Sightings>> sessions_;
  std::vector<ObjectPosition> expected_;  // in this scan's world
};

}  // namespace scantrove
