#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace scantrove {

/// A point of the cloud near a ray.
struct PickedPoint {
  Eigen::Vector3f point;
  float along;   ///< distance along the ray, metres
  float beside;  ///< distance from the ray, metres
};

/// A line of sight with the width of a drawn point.
class PickRay {
 public:
  /// `direction` of any length; the ray is `radius_m` thick and widens by `radians` with the distance.
  PickRay(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float radius_m, float radians)
      : origin_(origin), direction_(direction.normalized()), radius_m_(radius_m), radians_(radians) {}

  /// None if the point is outside of the ray's radius or behind its origin.
  [[nodiscard]] std::optional<PickedPoint> intersect(const Eigen::Vector3f& point) const;
  /// False only if the ray misses all points of the box.
  [[nodiscard]] bool mayIntersect(const Eigen::AlignedBox3f& box) const;

 private:
  Eigen::Vector3f origin_, direction_;
  float radius_m_, radians_;
};

/// The point of the first surface that is nearest to the ray. Points up to `depth_m` behind the first one
/// belong to the same surface.
[[nodiscard]] std::optional<Eigen::Vector3f> foremost(const std::vector<PickedPoint>& points, float depth_m);

}  // namespace scantrove
