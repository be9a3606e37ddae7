#include "core/discovery/region_points.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace scantrove {
namespace {

/// Calls `use` with each pixel of the regions that shows a surface.
template <class Use>
void forEachPixel(const RegionSet& regions, const cv::Rect& box, const DiscoveryInput& input, Use&& use) {
  for (int v = box.y; v < box.br().y; ++v) {
    const std::size_t row = static_cast<std::size_t>(v) * static_cast<std::size_t>(input.regions.width);
    for (int u = box.x; u < box.br().x; ++u) {
      const std::size_t pixel = row + static_cast<std::size_t>(u);
      if (!regions.contains(input.regions.regions[pixel])) continue;
      if (isSurface(input.vertices_world[pixel])) use(pixel);
    }
  }
}

/// Calls `use` with each vertex of the regions that is a surface point.
template <class Use>
void forEachPoint(const RegionSet& regions, const cv::Rect& box, const DiscoveryInput& input, Use&& use) {
  forEachPixel(regions, box, input, [&](std::size_t pixel) { use(input.vertices_world[pixel]); });
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
  forEachPoint({extent.region}, extent.box_px, input, [&](const Eigen::Vector4f& vertex) {
    const float z = depth(vertex);
    sum += static_cast<double>(z * z);
  });
  return static_cast<float>(sum / (static_cast<double>(input.K.fx) * static_cast<double>(input.K.fy)));
}

float bulgeOf(const RegionSet& regions, const cv::Rect& box_px, const DiscoveryInput& input) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  int points = 0;
  forEachPoint(regions, box_px, input, [&](const Eigen::Vector4f& vertex) {
    sum += vertex.head<3>();
    ++points;
  });
  const Eigen::Vector3f middle = sum / static_cast<float>(std::max(points, 1));
  float outwards = 0, away = 0;
  forEachPixel(regions, box_px, input, [&](std::size_t pixel) {
    if (!isSurface(input.normals_world[pixel])) return;
    const Eigen::Vector3f from_middle = input.vertices_world[pixel].head<3>() - middle;
    outwards += from_middle.dot(input.normals_world[pixel].head<3>());
    away += from_middle.norm();
  });
  return away > 0 ? outwards / away : 0;
}

std::vector<Eigen::Vector4f> pointsOf(const RegionSet& regions, const cv::Rect& box_px,
                                      const DiscoveryInput& input) {
  std::vector<Eigen::Vector4f> points;
  forEachPoint(regions, box_px, input, [&](const Eigen::Vector4f& vertex) { points.push_back(vertex); });
  return points;
}

}  // namespace scantrove
