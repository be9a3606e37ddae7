#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "core/base/result.h"
#include "core/capture/intrinsics.h"
#include "core/discovery/candidate_finder.h"
#include "core/labeling/region_map.h"

namespace scantrove {

class ScanPipeline;

/// What the map shows from a camera, with the regions as they are now, as discovery looks at a frame.
struct MapView {
  RegionMap regions;                            ///< without fragments
  std::vector<Eigen::Vector4f> vertices_world;  ///< row by row, w = 0: no surface
  Intrinsics K;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();

  /// Refers to this.
  [[nodiscard]] DiscoveryInput input() const { return {regions, vertices_world, {}, K, T_world_camera}; }
};

/// Error: the device failed.
[[nodiscard]] Result<MapView> viewMap(ScanPipeline& pipeline, const Intrinsics& K,
                                      const Eigen::Isometry3d& T_world_camera);

}  // namespace scantrove
