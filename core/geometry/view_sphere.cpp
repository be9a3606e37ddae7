#include "core/geometry/view_sphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scantrove {

bool ViewSphere::isNew(const Eigen::Vector3f& direction, float angle_deg) const {
  const float length = direction.norm();
  if (!(length > 1e-6F && length < 1e6F)) return false;
  const float cos_limit = std::cos(angle_deg * std::numbers::pi_v<float> / 180.0F);
  return std::ranges::all_of(
      directions_, [&](const Eigen::Vector3f& other) { return direction.dot(other) < cos_limit * length; });
}

}  // namespace scantrove
