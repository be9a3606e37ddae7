#include "ui/scene/cloud_pick.h"

#include <algorithm>

namespace scantrove {

std::optional<PickedPoint> PickRay::intersect(const Eigen::Vector3f& point) const {
  const Eigen::Vector3f offset = point - origin_;
  const float along = offset.dot(direction_);
  if (!(along > 0)) return std::nullopt;
  const float beside = (offset - along * direction_).norm();
  if (beside > std::max(radius_m_, along * radians_)) return std::nullopt;
  return PickedPoint{point, along, beside};
}

bool PickRay::mayIntersect(const Eigen::AlignedBox3f& box) const {
  if (box.isEmpty()) return false;
  // Tests the bounding sphere of the box.
  const float sphere_m = 0.5F * box.diagonal().norm();
  const Eigen::Vector3f offset = box.center() - origin_;
  const float along = offset.dot(direction_);
  if (along < -sphere_m) return false;
  const float beside = (offset - along * direction_).norm();
  return beside <= sphere_m + std::max(2 * radius_m_, (along + sphere_m) * radians_);
}

std::optional<Eigen::Vector3f> foremost(const std::vector<PickedPoint>& points, float depth_m) {
  const auto first = std::min_element(points.begin(), points.end(),
                                      [](const auto& a, const auto& b) { return a.along < b.along; });
  if (first == points.end()) return std::nullopt;
  const PickedPoint* best = &*first;
  for (const PickedPoint& point : points) {
    if (point.along <= first->along + depth_m && point.beside < best->beside) best = &point;
  }
  return best->point;
}

}  // namespace scantrove
