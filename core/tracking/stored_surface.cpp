#include "core/tracking/stored_surface.h"

#include <cmath>
#include <limits>

namespace scantrove {
namespace {

constexpr float kUnit_m = 0.000125F;  // 16 bits reach to 8.1 m
/// Relative depth difference above which neighbours belong to two surfaces.
constexpr float kJump = 0.03F;

}  // namespace

StoredSurface::StoredSurface(const Intrinsics& K, std::span<const cl_float4> vertices_camera)
    : K_(K), units_(cv::Mat::zeros(K.height, K.width, CV_16UC1)) {
  for (int i = 0; i < K.pixels(); ++i) {
    const cl_float4& vertex = vertices_camera[static_cast<std::size_t>(i)];
    const float units = vertex.s[2] / kUnit_m + 0.5F;
    if (vertex.s[3] > 0 && units < static_cast<float>(std::numeric_limits<std::uint16_t>::max()))
      units_.at<std::uint16_t>(i / K.width, i % K.width) = static_cast<std::uint16_t>(units);
  }
}

RenderedView StoredSurface::render(const Eigen::Isometry3d& T_world_camera) const {
  const Eigen::Isometry3f T = T_world_camera.cast<float>();
  const auto depthAt = [&](int u, int v) {
    return K_.isInside(u, v) ? kUnit_m * static_cast<float>(units_.at<std::uint16_t>(v, u)) : 0.0F;
  };
  const auto vertexAt = [&](int u, int v, float z) {
    return K_.backProject(static_cast<float>(u), static_cast<float>(v), z);
  };
  RenderedView view{K_, T_world_camera};
  view.vertices_world.assign(static_cast<std::size_t>(K_.pixels()), Eigen::Vector4f::Zero());
  view.normals_world = view.vertices_world;
  for (int v = 0; v < K_.height; ++v) {
    for (int u = 0; u < K_.width; ++u) {
      const float z = depthAt(u, v);
      if (z == 0) continue;
      const std::size_t i = K_.indexOf(u, v);
      view.vertices_world[i] << T * vertexAt(u, v, z), 1.0F;
      const float left = depthAt(u - 1, v), right = depthAt(u + 1, v);
      const float above = depthAt(u, v - 1), below = depthAt(u, v + 1);
      const auto isNear = [z](float other) { return other > 0 && std::abs(other - z) < kJump * z; };
      if (!isNear(left) || !isNear(right) || !isNear(above) || !isNear(below)) continue;
      const Eigen::Vector3f across = vertexAt(u + 1, v, right) - vertexAt(u - 1, v, left);
      const Eigen::Vector3f down = vertexAt(u, v + 1, below) - vertexAt(u, v - 1, above);
      // x is right, y down, z forward, so down x across points back at the camera.
      view.normals_world[i] << T.linear() * down.cross(across).normalized(), 1.0F;
    }
  }
  return view;
}

}  // namespace scantrove
