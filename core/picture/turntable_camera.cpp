#include "core/picture/turntable_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scantrove {
namespace {

constexpr float kSmallerFieldOfView_deg = 40;
constexpr float kMargin = 1.05F;  // of the radius of the content
constexpr float kLeastRadius_m = 1e-3F;

float radiansOf(double degrees) { return static_cast<float>(degrees * std::numbers::pi / 180); }

/// `direction` without its part along `up`; any horizontal direction if nothing is left.
Eigen::Vector3f horizontal(const Eigen::Vector3f& direction, const Eigen::Vector3f& up) {
  const Eigen::Vector3f flat = direction - direction.dot(up) * up;
  return flat.norm() > 1e-3F ? flat.normalized() : up.unitOrthogonal();
}

}  // namespace

TurntableCamera::TurntableCamera(const PictureSurface& surface, const Eigen::Vector3f& up_world,
                                 const Eigen::Vector3f& front_world, int width, int height)
    : up_(up_world.normalized()),
      front_(horizontal(front_world, up_)),
      left_(up_.cross(front_)),
      width_(width),
      height_(height) {
  Eigen::AlignedBox3f box;
  for (const PictureSurface::Vertex& vertex : surface.vertices) box.extend(vertex.position_world_m);
  if (!box.isEmpty()) center_ = box.center();
  float radius_m = kLeastRadius_m;
  for (const PictureSurface::Vertex& vertex : surface.vertices)
    radius_m = std::max(radius_m, (vertex.position_world_m - center_).norm());
  const float half = radiansOf(kSmallerFieldOfView_deg) / 2;
  distance_m_ = kMargin * radius_m / std::sin(half);
  focal_px_ = static_cast<float>(std::min(width, height)) / 2 / std::tan(half);
}

PictureCamera TurntableCamera::at(double azimuth_deg, double elevation_deg) const {
  const float azimuth = radiansOf(azimuth_deg), elevation = radiansOf(elevation_deg);
  const Eigen::Vector3f outward = std::cos(azimuth) * front_ + std::sin(azimuth) * left_;
  const Eigen::Vector3f to_camera = std::cos(elevation) * outward + std::sin(elevation) * up_;
  const Eigen::Vector3f forward = -to_camera;
  // Derived from the horizontal direction, so that straight up and down are no special case.
  const Eigen::Vector3f down = -(std::cos(elevation) * up_ - std::sin(elevation) * outward);
  PictureCamera camera{.focal_px = focal_px_, .width = width_, .height = height_};
  Eigen::Matrix3f rows;
  rows << down.cross(forward).transpose(), down.transpose(), forward.transpose();
  camera.T_camera_world.linear() = rows;
  camera.T_camera_world.translation() = -rows * (center_ + distance_m_ * to_camera);
  return camera;
}

}  // namespace scantrove
