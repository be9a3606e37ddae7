#include "core/scan/map_view.h"

#include <utility>

#include "core/scan/scan_pipeline.h"

namespace scantrove {

Result<MapView> viewMap(ScanPipeline& pipeline, const Intrinsics& K,
                        const Eigen::Isometry3d& T_world_camera) {
  auto seen = pipeline.renderView(T_world_camera, K);
  if (!seen) return fail(seen.error());
  MapView view;
  view.K = K;
  view.T_world_camera = T_world_camera;
  view.regions.width = seen->width;
  view.regions.height = seen->height;
  view.regions.regions = std::move(seen->regions);
  view.vertices_world.reserve(seen->depths_m.size());
  const Eigen::Isometry3f T = T_world_camera.cast<float>();
  for (int y = 0; y < K.height; ++y) {
    for (int x = 0; x < K.width; ++x) {
      const float z = seen->depths_m[view.vertices_world.size()];
      Eigen::Vector4f vertex = Eigen::Vector4f::Zero();
      if (z > 0) vertex << T * K.backProject(static_cast<float>(x), static_cast<float>(y), z), 1.0F;
      view.vertices_world.push_back(vertex);
    }
  }
  return view;
}

}  // namespace scantrove
