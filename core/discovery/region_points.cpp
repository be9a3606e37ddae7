#include "core/discovery/region_points.h"

#include <cmath>
#include <cstddef>

namespace scantrove {
namespace {

/// Calls `use` with each vertex of the region that is a surface point.
template <class Use>
void forEachPoint(const RegionExtent& extent, const DiscoveryInput& input, Use&& use) {
  const cv::Rect& box = extent.box_px;
  for (int v = box.y; v < box.br().y; ++v) {
    const std::size_t row = static_cast<std::size_t>(v) * static_cast<std::size_t>(input.regions.width);
    for (int u = box.x; u < box.br().x; ++u) {
      const std::size_t pixel = row + static_cast<std::size_t>(u);
      if (input.regions.regions[pixel] != extent.region.value) continue;
      const Eigen::Vector4f& vertex = input.vertices_world[pixel];
      if (vertex.w() != 0 && std::isfinite(vertex.x() + vertex.y() + vertex.z())) use(vertex);
    }
  }
}

}  // namespace

float visibleArea(const RegionExtent& extent, const DiscoveryInput& input) {
  // z of the camera frame = third row of T_camera_world.
  const Eigen::Matrix4f T_camera_world = input.T_world_camera.inverse().matrix().cast<float>();
  const Eigen::Vector3f axis = T_camera_world.block<1, 3>(2, 0).transpose();
  const float offset = T_camera_world(2, 3);
  double sum = 0;
  forEachPoint(extent, input, [&](const Eigen::Vector4f& vertex) {
    const float z = axis.dot(vertex.head<3>()) + offset;
    sum += static_cast<double>(z * z);
  });
  return static_cast<float>(sum / (static_cast<double>(input.K.fx) * static_cast<double>(input.K.fy)));
}

std::vector<Eigen::Vector4f> pointsOf(const RegionExtent& extent, const DiscoveryInput& input) {
  std::vector<Eigen::Vector4f> points;
  points.reserve(static_cast<std::size_t>(extent.pixels));
  forEachPoint(extent, input, [&](const Eigen::Vector4f& vertex) { points.push_back(vertex); });
  return points;
}

}  // namespace scantrove
