#include "core/fusion/rendered_view.h"

#include <algorithm>

#include "core/compute/compute_context.h"
#include "core/fusion/surface_maps.h"
#include "core/geometry/camera_depth.h"

namespace scantrove {

static_assert(sizeof(Eigen::Vector4f) == sizeof(cl_float4));

DepthView RenderedView::depth() const {
  DepthView view{K, T_world_camera, {}};
  if (vertices_world.empty()) return view;
  view.z_m.create(K.height, K.width, CV_32FC1);
  std::ranges::transform(vertices_world, view.z_m.begin<float>(),
                         [depth = CameraDepth(T_world_camera)](const Eigen::Vector4f& vertex) {
                           return vertex.w() > 0 ? depth(vertex) : 0.0F;
                         });
  return view;
}

RenderedView readView(ComputeContext& compute, const SurfaceMaps& surface) {
  const auto read = [&](const Buffer<cl_float4>& from) {
    std::vector<Eigen::Vector4f> to(from.size() > 0 ? static_cast<std::size_t>(surface.K.pixels()) : 0);
    from.read(compute.queue(), {reinterpret_cast<cl_float4*>(to.data()), to.size()});
    return to;
  };
  RenderedView view;
  view.K = surface.K;
  view.T_world_camera = surface.T_world_camera;
  view.vertices_world = read(surface.vertices_world);
  view.normals_world = read(surface.normals_world);
  return view;
}

void writeView(ComputeContext& compute, const RenderedView& view, SurfaceMaps& surface) {
  surface.K = view.K;
  surface.T_world_camera = view.T_world_camera;
  const auto write = [&](const std::vector<Eigen::Vector4f>& from, Buffer<cl_float4>& to) {
    if (to.size() != from.size()) to = {compute.context(), from.size()};
    to.write(compute.queue(), {reinterpret_cast<const cl_float4*>(from.data()), from.size()});
  };
  write(view.vertices_world, surface.vertices_world);
  write(view.normals_world, surface.normals_world);
}

}  // namespace scantrove
