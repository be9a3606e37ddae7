#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace scantrove {

/// A point of the cloud that lies near a ray.
struct PickedPoint {
  Eigen::Vector3f place;
  float along;   ///< the ray, metres
  float beside;  ///< it, metres
};

/// A line of sight, as wide as a point is drawn.
class PickRay {
 public:
  /// `direction` of any length; the ray is `radius_m` thick and widens by `radians` with the distance.
  PickRay(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float radius_m, float radians)
      : origin_(origin), direction_(direction.normalized()), radius_m_(radius_m), radians_(radians) {}

  /// None when the point is farther from the ray than that, or behind its origin.
  [[nodiscard]] std::optional<PickedPoint> meet(const Eigen::Vector3f& point) const;
  /// False only when no point of the box is met.
  [[nodiscard]] bool mayIntersect(const Eigen::AlignedBox3f& box) const;

 private:
  Eigen::Vector3f origin_, direction_;
  float radius_m_, radians_;
};

/// Of what a ray met, the point of the foremost surface that is nearest to the ray. `depth_m`: so far behind
/// the first point still is the same surface.
[[nodiscard]] std::optional<Eigen::Vector3f> foremost(const std::vector<PickedPoint>& points, float depth_m);

}  // namespace scantrove
