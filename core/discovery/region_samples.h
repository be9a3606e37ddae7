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

/// All that a map knows of its regions, in some hundred points each: how large they are, what shape, and
/// how much of them a view could show.
class RegionSamples {
 public:
  /// Points of a region's surface, each once: world, m, and the normal there, 0 where it is not known.
  void add(RegionId region, const Eigen::Vector3f& point_world, const Eigen::Vector3f& normal_world);

  struct Shape {
    OrientedBox box;
    float bulge = 0;  ///< as bulgeOf(), of all sides that were seen
  };
  /// Of the regions together; nothing is known of a region that there is not.
  [[nodiscard]] Shape shapeOf(const RegionSet& regions) const;

  /// The part of its points that lies within `visible_px` of the camera's image, behind something else or
  /// not; 0 where none is known.
  [[nodiscard]] float partInView(RegionId region, const Intrinsics& K,
                                 const Eigen::Isometry3d& T_world_camera, const cv::Rect& visible_px) const;

 private:
  struct Sample {
    std::vector<Eigen::Vector4f> points;   ///< w = 1
    std::vector<Eigen::Vector3f> normals;  ///< of these points
    std::size_t added = 0, step = 1;       ///< every step-th point is kept
  };
  std::unordered_map<RegionId, Sample> samples_;
};

}  // namespace scantrove
