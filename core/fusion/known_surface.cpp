#include "core/fusion/known_surface.h"

#include <opencv2/core/utility.hpp>

namespace scantrove {
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
