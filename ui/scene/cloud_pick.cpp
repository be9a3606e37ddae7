#include "ui/scene/cloud_pick.h"

#include <algorithm>

namespace scantrove {

std::optional<PickedPoint> PickRay::meet(const Eigen::Vector3f& point) const {
  const Eigen::Vector3f way = point - origin_;
  const float along = way.dot(direction_);
  if (!(along > 0)) return std::nullopt;
  const float beside = (way - along * direction_).norm();
  if (beside > std::max(radius_m_, along * radians_)) return std::nullopt;
  return PickedPoint{point, along, beside};
}

bool PickRay::mayIntersect(const Eigen::AlignedBox3f& box) const {
  if (box.isEmpty()) return false;
  // The ray meets the ball around the box.
  const float ball_m = 0.5F * box.diagonal().norm();
  const Eigen::Vector3f way = box.center() - origin_;
  const float along = way.dot(direction_);
  if (along < -ball_m) return false;
  const float beside = (way - along * direction_).norm();
  return beside <= ball_m + std::max(2 * radius_m_, (along + ball_m) * radians_);
}

std::optional<Eigen::Vector3f> foremost(const std::vector<PickedPoint>& points, float depth_m) {
  const auto first = std::min_element(points.begin(), points.end(),
                                      [](const auto& a, const auto& b) { return a.along < b.along; });
  if (first == points.end()) return std::nullopt;
  const PickedPoint* best = &*first;
  for (const PickedPoint& point : points) {
    if (point.along <= first->along + depth_m && point.beside < best->beside) best = &point;
  }
  return best->place;
}

}  // namespace scantrove
