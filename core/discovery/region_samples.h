#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <opencv2/core/types.hpp>
#include <unordered_map>
#include <vector>

#include "core/base/ids.h"
#include "core/capture/intrinsics.h"
#include "core/discovery/oriented_box.h"
#include "core/discovery/region_set.h"

namespace scantrove {

/// A few hundred points of each region of a map, for size, shape and the part that a view could show.
class RegionSamples {
 public:
  /// Adds a point of a region's surface (each once), world, m, with its normal; 0 if unknown.
  void add(RegionId region, const Eigen::Vector3f& point_world, const Eigen::Vector3f& normal_world);

  struct Shape {
    OrientedBox box;
    float bulge = 0;  ///< as bulgeOf(), over all sides that were seen
  };
  /// The shape of the regions together; unknown regions are ignored.
  [[nodiscard]] Shape shapeOf(const RegionSet& regions) const;

  /// The part of its points that projects into `visible_px`, occluded or not; 0 without points.
  [[nodiscard]] float partInView(RegionId region, const Intrinsics& K,
                                 const Eigen::Isometry3d& T_world_camera, const cv::Rect& visible_px) const;

 private:
  struct Sample {
    std::vector<Eigen::Vector4f> points;   ///< w = 1
    std::vector<Eigen::Vector3f> normals;  ///< of `points`
    std::size_t added = 0, step = 1;       ///< every step-th point is kept
  };
  std::unordered_map<RegionId, Sample> samples_;
};

}  // namespace scantrove
