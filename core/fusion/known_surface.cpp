#include "core/fusion/known_surface.h"

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <span>
#include <vector>

namespace scantrove {
namespace {

std::vector<Eigen::Vector4f> verticesOf(ComputeContext& compute, const SurfaceMaps& surface) {
  std::vector<Eigen::Vector4f> vertices(surface.vertices_world.size());
  static_assert(sizeof(Eigen::Vector4f) == sizeof(cl_float4));
  surface.vertices_world.read(compute.queue(),
                              {reinterpret_cast<cl_float4*>(vertices.data()), vertices.size()});
  return vertices;
}

}  // namespace

KnownSurface::KnownSurface(const Intrinsics& K, const Eigen::Isometry3d& T_world_camera,
                           std::span<const Eigen::Vector4f> vertices_world)
    : view_{K, T_world_camera, {}} {
  if (vertices_world.empty()) return;
  view_.z_m.create(K.height, K.width, CV_32FC1);
  const Eigen::RowVector4f depth_row = T_world_camera.inverse().matrix().row(2).cast<float>();
  std::ranges::transform(vertices_world, view_.z_m.begin<float>(), [&](const Eigen::Vector4f& v) {
    return v.w() > 0 ? depth_row.dot(Eigen::Vector4f(v.x(), v.y(), v.z(), 1)) : 0.0F;
  });
}

KnownSurface::KnownSurface(ComputeContext& compute, const SurfaceMaps& surface)
    : KnownSurface(surface.K, surface.T_world_camera, verticesOf(compute, surface)) {}

cv::Mat KnownSurface::consistencies(const DepthView& now, float depth_noise_m) const {
  cv::Mat consistencies(now.z_m.size(), CV_8UC1);
  const Eigen::Affine3f T((view_.T_world_camera.inverse() * now.T_world_camera).cast<float>());
  const Intrinsics& K = view_.K;
  const auto consistencyOf = [&](int u, int v, float z) {
    if (!(z > 0)) return DepthConsistency::none;
    const Eigen::Vector3f q = T * Eigen::Vector3f((static_cast<float>(u) - now.K.cx) / now.K.fx * z,
                                                  (static_cast<float>(v) - now.K.cy) / now.K.fy * z, z);
    if (view_.z_m.empty() || !(q.z() > 0)) return DepthConsistency::unknown;
    const float x = K.fx * q.x() / q.z() + K.cx + 0.5F;
    const float y = K.fy * q.y() / q.z() + K.cy + 0.5F;
    if (!(x >= 0 && y >= 0 && x < static_cast<float>(K.width) && y < static_cast<float>(K.height)))
      return DepthConsistency::unknown;
    const float known = view_.z_m.at<float>(static_cast<int>(y), static_cast<int>(x));
    if (!(known > 0)) return DepthConsistency::unknown;
    if (q.z() < known - kBefore.at(q.z(), depth_noise_m)) return DepthConsistency::before;
    return q.z() > known + kBehind.at(q.z(), depth_noise_m) ? DepthConsistency::behind
                                                            : DepthConsistency::fits;
  };
  cv::parallel_for_({0, now.z_m.rows}, [&](const cv::Range& rows) {
    for (int v = rows.start; v < rows.end; ++v) {
      const auto* z = now.z_m.ptr<float>(v);
      auto* consistency = consistencies.ptr<std::uint8_t>(v);
      for (int u = 0; u < now.z_m.cols; ++u)
        consistency[u] = static_cast<std::uint8_t>(consistencyOf(u, v, z[u]));
    }
  });
  return consistencies;
}

}  // namespace scantrove
