#pragma once
#include <Eigen/Core>
#include <functional>
#include <map>
#include <vector>

#include "core/base/ids.h"

namespace scantrove {

/// What a person painted in an image, as seen from the surface behind it.
struct PaintedSurface {
  /// Where a point of the surface lies in the image.
  enum class Area {
    added,    ///< well inside what was added to the region
    removed,  ///< well inside what was painted out of it
    other,    ///< well away from both
    unclear,  ///< near an outline, within the error of the registration
    beyond    ///< not in the image
  };
  struct Sight {
    Area area = Area::beyond;
    bool is_visible = false;  ///< nothing hides it from the camera
  };
  /// `point_world` in metres.
  std::function<Sight(const Eigen::Vector3f& point_world)> sight;
  /// Some visible places in added pixels, by their region, metres.
  std::map<RegionId, std::vector<Eigen::Vector3f>> added_world = {};
  /// Some visible places of the painted region in removed pixels, metres.
  std::vector<Eigen::Vector3f> removed_world = {};
  /// Other regions that the image shows beside those removed pixels, most pixels first.
  std::vector<RegionId> around = {};
};

}  // namespace scantrove
