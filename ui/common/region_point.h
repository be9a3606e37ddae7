#pragma once
#include <Eigen/Core>
#include <optional>

#include "core/base/ids.h"

namespace scantrove {

/// What a view shows at a place: the region of the surface there, never of something behind it.
struct RegionPoint {
  RegionId region;                             ///< none: no surface, or none with a label
  std::optional<Eigen::Vector3f> point_world;  ///< metres; none: no surface
};

}  // namespace scantrove
