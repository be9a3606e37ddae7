#include "core/discovery/region_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace scantrove {
namespace {

bool isSurface(const Eigen::Vector4f& vertex) {
  return vertex.w() != 0 && std::isfinite(vertex.x() + vertex.y() + vertex.z());
}

/// Calls `use` with each vertex of the region that is a surface point, and its pixel.
template <class Use>
void forEachPoint(const RegionExtent& extent, const DiscoveryInput& input, Use&& use) {
  const cv::Rect& box = extent.box_px;
  for (int v = box.y; v < box.br().y; ++v) {
    const std::size_t row = static_cast<std::size_t>(v) * static_cast<std::size_t>(input.regions.width);
    for (int u = box.x; u < box.br().x; ++u) {
      const std::size_t pixel = row + static_cast<std::size_t>(u);
      if (input.regions.regions[pixel] != extent.region) continue;
      if (isSurface(input.vertices_world[pixel])) use(input.vertices_world[pixel], u, v);
    }
  }
}

/// z in the camera frame of world points.
class CameraDepth {
 public:
  explicit CameraDepth(const DiscoveryInput& input) {
    const Eigen::Matrix4f T_camera_world = input.T_world_camera.inverse().matrix().cast<float>();
    axis_ = T_camera_world.block<1, 3>(2, 0).transpose();
    offset_ = T_camera_world(2, 3);
  }
  [[nodiscard]] float operator()(const Eigen::Vector4f& vertex) const {
    return axis_.dot(vertex.head<3>()) + offset_;
  }

 private:
  Eigen::Vector3f axis_;
  float offset_;
};

}  // namespace

float visibleArea(const RegionExtent& extent, const DiscoveryInput& input) {
  const CameraDepth depth(input);
  double sum = 0;
  forEachPoint(extent, input, [&](const Eigen::Vector4f& vertex, int, int) {
    const float z = depth(vertex);
    sum += static_cast<double>(z * z);
  });
  return static_cast<float>(sum / (static_cast<double>(input.K.fx) * static_cast<double>(input.K.fy)));
}

float hiddenFraction(const RegionExtent& extent, const DiscoveryInput& input, const DiscoveryParams& params) {
  constexpr float kGrowsFrom_m = 1.5F;
  constexpr int kStep = 2;  // pixels at an edge may lie between the two surfaces: look beyond the first
  const int width = input.regions.width, height = input.regions.height;
  const auto pixelAt = [&](int u, int v) {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  };
  const CameraDepth depth(input);
  int steps = 0, hidden = 0;
  forEachPoint(extent, input, [&](const Eigen::Vector4f& vertex, int u, int v) {
    for (const auto& [du, dv] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
      const int far_u = u + kStep * du, far_v = v + kStep * dv;
      if (far_u < 0 || far_v < 0 || far_u >= width || far_v >= height) continue;
      if (input.regions.regions[pixelAt(u + du, v + dv)] == extent.region) continue;
      const std::size_t beyond = pixelAt(far_u, far_v);
      if (input.regions.regions[beyond] == extent.region || !isSurface(input.vertices_world[beyond]))
        continue;
      const float z = depth(vertex);
      ++steps;
      if (depth(input.vertices_world[beyond]) < z - params.hiding_step_m * std::max(1.0F, z / kGrowsFrom_m))
        ++hidden;
    }
  });
  return steps == 0 ? 0 : static_cast<float>(hidden) / static_cast<float>(steps);
}

std::vector<Eigen::Vector4f> pointsOf(const RegionExtent& extent, const DiscoveryInput& input) {
  std::vector<Eigen::Vector4f> points;
  points.reserve(static_cast<std::size_t>(extent.pixels));
  forEachPoint(extent, input, [&](const Eigen::Vector4f& vertex, int, int) { points.push_back(vertex); });
  return points;
}

}  // namespace scantrove
