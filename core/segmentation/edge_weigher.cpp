#include "core/segmentation/edge_weigher.h"

#include <algorithm>

#include "core/compute/kernel_types.h"
#include "core/geometry/camera_depth.h"
#include "embedded/segmentation_kernels.h"

namespace scantrove {

Result<EdgeWeigher> EdgeWeigher::create(ComputeContext& compute) {
  Result<Kernel> kernel = compute.kernel(kernels::segmentation, "weigh_edges");
  if (!kernel) return fail(kernel.error());
  return EdgeWeigher(compute, std::move(*kernel));
}

void EdgeWeigher::weigh(const SurfaceMaps& surface, const Buffer<cl_float4>& normals,
                        const SegmentationParams& params, EdgeKeys& edges) {
  const auto pixels = static_cast<std::size_t>(std::max(surface.K.pixels(), 0));
  edges.width = surface.K.width;
  edges.height = surface.K.height;
  edges.keys.resize(pixels);
  edges.depths_m.resize(pixels);
  if (pixels == 0) return;
  SCANTROVE_CHECK(surface.vertices_world.size() >= pixels && normals.size() >= pixels);
  if (keys_.size() != pixels) {
    keys_ = Buffer<cl_ushort4>(compute_->context(), pixels);
    depths_ = Buffer<cl_float>(compute_->context(), pixels);
  }
  const Eigen::RowVector4f row = CameraDepth(surface.T_world_camera).row();
  const float focal_px = std::min(surface.K.fx, surface.K.fy);
  const Lanes& lanes = compute_->lanes();
  kernel_.launch(lanes.overRows(surface.K.width, surface.K.height), lanes.rowGroup(), surface.vertices_world,
                 normals, keys_, depths_, surface.K.width, surface.K.height, params.neighbors,
                 toKernel(row[0], row[1], row[2], row[3]), params.max_distance_factor / focal_px,
                 params.min_max_distance_m);
  keys_.read(compute_->queue(), std::span<cl_ushort4>(edges.keys));
  depths_.read(compute_->queue(), std::span<cl_float>(edges.depths_m));
}

}  // namespace scantrove
