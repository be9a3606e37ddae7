#pragma once
#include <Eigen/Core>
#include <optional>

#include "core/base/ids.h"

namespace scantrove {

/// Region and surface point that a view shows at a position, never those of a hidden surface.
struct RegionPoint {
  RegionId region;                             ///< none: no surface, or none with a label
  std::optional<Eigen::Vector3f> point_world;  ///< metres; none: no surface
};

}  // namespace scantrove
