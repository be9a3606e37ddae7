#include "core/fusion/contradicted_surface.h"

#include <algorithm>
#include <cmath>

#include "core/base/check.h"
#include "core/geometry/camera_depth.h"

namespace scantrove {

cv::Mat contradictedSurface(const DepthView& now, const RenderedView& view, float depth_noise_m) {
  const Intrinsics& K = view.K;
  SCANTROVE_CHECK(static_cast<int>(view.vertices_world.size()) == K.pixels());
  SCANTROVE_CHECK(now.z_m.type() == CV_32FC1);
  cv::Mat contradicted = cv::Mat::zeros(K.height, K.width, CV_8UC1);
  const CameraDepth depth_of(now.T_world_camera);
  const float sx = static_cast<float>(now.z_m.cols) / static_cast<float>(K.width);
  const float sy = static_cast<float>(now.z_m.rows) / static_cast<float>(K.height);
  const auto readingsAt = [](int pixel, float scale, int count) {
    return std::clamp(static_cast<int>((static_cast<float>(pixel) + 0.5F) * scale), 0, count - 1);
  };
  // A working pixel to each side.
  const cv::Point reach(static_cast<int>(std::ceil(sx)), static_cast<int>(std::ceil(sy)));
  const cv::Rect image({}, now.z_m.size());
  for (int v = 0; v < K.height; ++v) {
    for (int u = 0; u < K.width; ++u) {
      const Eigen::Vector4f& vertex = view.vertices_world[K.indexOf(u, v)];
      if (!(vertex.w() > 0)) continue;
      const float z = depth_of(vertex);
      const float nearest = z - kBefore.at(z, depth_noise_m), farthest = z + kBehind.at(z, depth_noise_m);
      const auto agrees = [&](float reading) { return reading >= nearest && reading <= farthest; };
      const cv::Point pixel(readingsAt(u, sx, image.width), readingsAt(v, sy, image.height));
      const float reading = now.z_m.at<float>(pixel);
      if (!(reading > 0) || agrees(reading)) continue;
      const cv::Rect around = cv::Rect(pixel - reach, pixel + reach + cv::Point(1, 1)) & image;
      bool any_agrees = false;
      for (int y = around.y; y < around.br().y && !any_agrees; ++y) {
        const float* row = now.z_m.ptr<float>(y);
        any_agrees = std::any_of(row + around.x, row + around.br().x, agrees);
      }
      if (!any_agrees) contradicted.at<std::uint8_t>(v, u) = 255;
    }
  }
  return contradicted;
}

}  // namespace scantrove
