#include "core/discovery/region_samples.h"

#include <algorithm>

namespace scantrove {
namespace {

constexpr std::size_t kMaxPoints = 512;  // per region, evenly chosen: enough for box and bulge

/// Keeps every second one.
template <class T>
void thinOut(std::vector<T>& all) {
  for (std::size_t i = 0; 2 * i < all.size(); ++i) all[i] = all[2 * i];
  all.resize((all.size() + 1) / 2);
}

}  // namespace

void RegionSamples::add(RegionId region, const Eigen::Vector3f& point_world,
                        const Eigen::Vector3f& normal_world) {
  Sample& sample = samples_[region];
  if (sample.added++ % sample.step != 0) return;
  if (sample.points.size() == kMaxPoints) {
    thinOut(sample.points);
    thinOut(sample.normals);
    sample.step *= 2;
  }
  sample.points.push_back(point_world.homogeneous());
  sample.normals.push_back(normal_world);
}

RegionSamples::Shape RegionSamples::shapeOf(const RegionSet& regions) const {
  // Points of each region in proportion to its size.
  std::size_t step = 1;
  std::vector<const Sample*> parts;
  for (const RegionId region : regions) {
    const auto found = samples_.find(region);
    if (found == samples_.end()) continue;
    parts.push_back(&found->second);
    step = std::max(step, found->second.step);
  }
  std::vector<Eigen::Vector4f> points;
  std::vector<Eigen::Vector3f> normals;
  for (const Sample* part : parts) {
    for (std::size_t i = 0; i < part->points.size(); i += step / part->step) {
      points.push_back(part->points[i]);
      normals.push_back(part->normals[i]);
    }
  }
  Shape shape{fitOrientedBox(points), 0};
  float outwards = 0, away = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (normals[i].isZero()) continue;
    const Eigen::Vector3f from_middle = points[i].head<3>() - shape.box.mean;
    outwards += from_middle.dot(normals[i]);
    away += from_middle.norm();
  }
  if (away > 0) shape.bulge = outwards / away;
  return shape;
}

float RegionSamples::partInView(RegionId region, const Intrinsics& K, const Eigen::Isometry3d& T_world_camera,
                                const cv::Rect& visible_px) const {
  const auto found = samples_.find(region);
  if (found == samples_.end()) return 0;
  const std::vector<Eigen::Vector4f>& points = found->second.points;
  const Eigen::Isometry3f T_camera_world = T_world_camera.inverse().cast<float>();
  const cv::Rect_<float> visible(visible_px);
  std::size_t in_view = 0;
  for (const Eigen::Vector4f& point : points) {
    const Eigen::Vector3f p = T_camera_world * point.head<3>();
    if (!(p.z() > 0)) continue;
    const cv::Point2f seen(K.fx * p.x() / p.z() + K.cx, K.fy * p.y() / p.z() + K.cy);
    in_view += visible.contains(seen) ? 1 : 0;
  }
  return static_cast<float>(in_view) / static_cast<float>(points.size());
}

}  // namespace scantrove
