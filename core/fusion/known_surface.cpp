#include "core/fusion/known_surface.h"

#include <opencv2/core/utility.hpp>
#include <span>
#include <vector>

namespace scantrove {

KnownSurface::KnownSurface(ComputeContext& compute, const SurfaceMaps& surface)
    : view_{surface.K, surface.T_world_camera, cv::Mat(surface.K.height, surface.K.width, CV_32FC1)} {
  const std::vector<cl_float4> vertices = surface.vertices_world.read(compute.queue());
  const Eigen::RowVector4f depth_row = surface.T_world_camera.inverse().matrix().row(2).cast<float>();
  cv::parallel_for_({0, view_.z_m.rows}, [&](const cv::Range& rows) {
    auto* z = view_.z_m.ptr<float>(rows.start);
    const auto columns = static_cast<std::size_t>(view_.z_m.cols);
    for (const cl_float4& v : std::span(vertices).subspan(static_cast<std::size_t>(rows.start) * columns,
                                                          static_cast<std::size_t>(rows.size()) * columns))
      *z++ = v.s[3] > 0 ? depth_row.dot(Eigen::Vector4f(v.s[0], v.s[1], v.s[2], 1)) : 0.0F;
  });
}

cv::Mat KnownSurface::standings(const DepthView& now, float depth_noise_m) const {
  cv::Mat standings(now.z_m.size(), CV_8UC1);
  const Eigen::Affine3f T((view_.T_world_camera.inverse() * now.T_world_camera).cast<float>());
  const Intrinsics& K = view_.K;
  const auto standingOf = [&](int u, int v, float z) {
    if (!(z > 0)) return Standing::none;
    const Eigen::Vector3f q = T * Eigen::Vector3f((static_cast<float>(u) - now.K.cx) / now.K.fx * z,
                                                  (static_cast<float>(v) - now.K.cy) / now.K.fy * z, z);
    if (view_.z_m.empty() || !(q.z() > 0)) return Standing::unknown;
    const float x = K.fx * q.x() / q.z() + K.cx + 0.5F;
    const float y = K.fy * q.y() / q.z() + K.cy + 0.5F;
    if (!(x >= 0 && y >= 0 && x < static_cast<float>(K.width) && y < static_cast<float>(K.height)))
      return Standing::unknown;
    const float known = view_.z_m.at<float>(static_cast<int>(y), static_cast<int>(x));
    if (!(known > 0)) return Standing::unknown;
    if (q.z() < known - kBefore.at(q.z(), depth_noise_m)) return Standing::before;
    return q.z() > known + kBehind.at(q.z(), depth_noise_m) ? Standing::behind : Standing::fits;
  };
  cv::parallel_for_({0, now.z_m.rows}, [&](const cv::Range& rows) {
    for (int v = rows.start; v < rows.end; ++v) {
      const auto* z = now.z_m.ptr<float>(v);
      auto* standing = standings.ptr<std::uint8_t>(v);
      for (int u = 0; u < now.z_m.cols; ++u) standing[u] = static_cast<std::uint8_t>(standingOf(u, v, z[u]));
    }
  });
  return standings;
}

}  // namespace scantrove
