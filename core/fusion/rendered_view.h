#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/base/ids.h"
#include "core/capture/intrinsics.h"
#include "core/fusion/depth_view.h"

namespace scantrove {

class ComputeContext;
struct SurfaceMaps;

/// The map rendered from a pose, on the host. Each image has K.pixels() elements, row by row, or none if it
/// was not requested.
struct RenderedView {
  Intrinsics K;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Vector4f> vertices_world{};  ///< V_t: (x, y, z, 1) metres; all 0: no surface
  std::vector<Eigen::Vector4f> normals_world{};   ///< N_t: (x, y, z, 1) unit, towards the camera; all 0: none
  std::vector<FragmentId> fragments{};            ///< of the surface; none: unlabelled
  std::vector<RegionId> regions{};                ///< of the fragments; none: unlabelled
  /// 1: the vertex is estimated, because no depth image shows the surface (EstimatedLabels); empty: none is.
  std::vector<std::uint8_t> is_estimated{};

  /// Depth of the vertices, 0: no surface. An empty image without vertices.
  [[nodiscard]] DepthView depth() const;
};

/// Camera, vertices and normals of `surface`, read from the device. A surface without buffers gives no
/// images. May throw cl::Error.
[[nodiscard]] RenderedView readView(ComputeContext& compute, const SurfaceMaps& surface);
/// Writes the images to `surface` on the device. May throw cl::Error.
void writeView(ComputeContext& compute, const RenderedView& view, SurfaceMaps& surface);

}  // namespace scantrove
