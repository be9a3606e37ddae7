#pragma once
#include <Eigen/Core>
#include <map>
#include <vector>

#include "core/base/ids.h"
#include "core/catalog/detection_params.h"

namespace scantrove {

/// The sphere of viewing directions around each object of one scan: decides which looks are new enough to
/// keep. Directions are unit vectors from the object's centroid to the camera in the world of *this* scan.
/// Views of earlier scans lie in other worlds: they count towards `max_views` (see countStored) but have no
/// direction here. One thread.
class ViewSphere {
 public:
  explicit ViewSphere(const DetectionParams& params) : params_(params) {}
  void setParams(const DetectionParams& params) { params_ = params; }

  /// True when the angle to every kept direction exceeds `new_view_angle_deg` and the object has room for a
  /// view. False for a direction that is not a finite, non-zero vector.
  [[nodiscard]] bool isNew(ObjectId object, const Eigen::Vector3f& direction) const;
  void keep(ObjectId object, const Eigen::Vector3f& direction);

  /// The object has `views` stored by earlier scans.
  void countStored(ObjectId object, int views) { objects_[object].stored = views; }
  /// `from` is now part of `into`: its views go with it.
  void merge(ObjectId into, ObjectId from);
  void forget(ObjectId object) { objects_.erase(object); }

 private:
  struct Kept {
    std::vector<Eigen::Vector3f> directions;  // unit
    int stored = 0;
  };
  DetectionParams params_;
  std::map<ObjectId, Kept> objects_;
};

}  // namespace scantrove
