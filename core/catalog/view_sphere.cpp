#include "core/catalog/view_sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scantrove {

bool ViewSphere::isNew(ObjectId object, const Eigen::Vector3f& direction) const {
  const float length = direction.norm();
  if (!(length > 1e-6F && length < 1e6F)) return false;
  const auto found = objects_.find(object);
  if (found == objects_.end()) return params_.max_views > 0;
  const Kept& kept = found->second;
  if (kept.stored + static_cast<int>(kept.directions.size()) >= params_.max_views) return false;
  const float cos_limit = std::cos(params_.new_view_angle_deg * std::numbers::pi_v<float> / 180.0F);
  return std::ranges::all_of(kept.directions, [&](const Eigen::Vector3f& other) {
    return direction.dot(other) < cos_limit * length;
  });
}

void ViewSphere::keep(ObjectId object, const Eigen::Vector3f& direction) {
  objects_[object].directions.push_back(direction.normalized());
}

void ViewSphere::merge(ObjectId into, ObjectId from) {
  const auto found = objects_.find(from);
  if (found == objects_.end() || into == from) return;
  const Kept moved = found->second;
  objects_.erase(found);
  Kept& kept = objects_[into];
  kept.stored += moved.stored;
  kept.directions.insert(kept.directions.end(), moved.directions.begin(), moved.directions.end());
}

}  // namespace scantrove
