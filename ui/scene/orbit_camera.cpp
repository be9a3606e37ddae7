#include "ui/scene/orbit_camera.h"

#include <vtkCamera.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scantrove {
namespace {

constexpr float kViewAngle_deg = 40;
constexpr float kPoleMargin_rad = 0.08F;
constexpr float kMinDistance_m = 0.05F;
constexpr float kMaxDistance_m = 200;

float halfViewAngle() { return kViewAngle_deg * std::numbers::pi_v<float> / 360; }

}  // namespace

void OrbitCamera::setUp(const Eigen::Vector3f& up) {
  up_ = up.normalized();
  orbit(0, 0);
}

void OrbitCamera::orbit(float yaw, float pitch) {
  const float elevation = std::asin(std::clamp(-forward_.dot(up_), -1.0F, 1.0F));
  const float limit = std::numbers::pi_v<float> / 2 - kPoleMargin_rad;
  const float requested = std::clamp(elevation + pitch, -limit, limit);
  Eigen::Vector3f level = forward_ - forward_.dot(up_) * up_;
  level = level.squaredNorm() > 1e-8F ? Eigen::Vector3f(level.normalized())
                                      : Eigen::Vector3f(up_.unitOrthogonal());
  level = Eigen::AngleAxisf(yaw, up_) * level;
  forward_ = std::cos(requested) * level - std::sin(requested) * up_;
}

void OrbitCamera::pan(float right, float up) {
  const Eigen::Vector3f side = forward_.cross(up_).normalized();
  const Eigen::Vector3f top = side.cross(forward_);
  const float height_m = 2 * distance_ * std::tan(halfViewAngle());
  target_ += height_m * (right * side + up * top);
}

void OrbitCamera::zoom(float factor) {
  distance_ = std::clamp(distance_ * factor, kMinDistance_m, kMaxDistance_m);
}

void OrbitCamera::lookAlong(const Eigen::Vector3f& direction) {
  forward_ = direction.normalized();
  orbit(0, 0);
}

void OrbitCamera::fit(const Eigen::AlignedBox3f& box, float aspect) {
  if (box.isEmpty()) return;
  const float radius = std::max(0.1F, 0.5F * box.diagonal().norm());
  target_ = box.center();
  const float narrow = std::atan(std::tan(halfViewAngle()) * std::min(1.0F, aspect));
  distance_ = std::clamp(0.82F * radius / std::sin(narrow), kMinDistance_m, kMaxDistance_m);
}

void OrbitCamera::lookAt(const Eigen::Vector3f& eye, const Eigen::Vector3f& target) {
  const Eigen::Vector3f offset = target - eye;
  if (!(offset.norm() > 1e-4F)) return;
  target_ = target;
  distance_ = std::clamp(offset.norm(), kMinDistance_m, kMaxDistance_m);
  forward_ = offset.normalized();
  orbit(0, 0);
}

void OrbitCamera::approach(const Eigen::Vector3f& eye, const Eigen::Vector3f& target, float fraction) {
  const Eigen::Vector3f here = this->eye();
  lookAt(here + fraction * (eye - here), target_ + fraction * (target - target_));
}

Eigen::Vector3f OrbitCamera::rayAt(float x, float y, float aspect) const {
  const Eigen::Vector3f side = forward_.cross(up_).normalized();
  const float half_height = std::tan(halfViewAngle());
  return (forward_ + half_height * (aspect * x * side + y * side.cross(forward_))).normalized();
}

std::optional<Eigen::Vector2f> OrbitCamera::positionOf(const Eigen::Vector3f& point, float aspect) const {
  const Eigen::Vector3f offset = point - eye();
  const float ahead = offset.dot(forward_);
  if (ahead < 1e-4F) return std::nullopt;
  const Eigen::Vector3f side = forward_.cross(up_).normalized();
  const float half_height = ahead * std::tan(halfViewAngle());
  return Eigen::Vector2f(offset.dot(side) / (half_height * aspect),
                         offset.dot(side.cross(forward_)) / half_height);
}

float OrbitCamera::radiansPerPixel(int height_px) {
  return 2 * std::tan(halfViewAngle()) / static_cast<float>(std::max(1, height_px));
}

void OrbitCamera::applyTo(vtkCamera* camera, const Eigen::AlignedBox3f& scene) const {
  const Eigen::Vector3d from = eye().cast<double>();
  const Eigen::Vector3d to = target_.cast<double>();
  const Eigen::Vector3d upright = up_.cast<double>();
  camera->SetViewAngle(kViewAngle_deg);
  camera->SetPosition(from.data());
  camera->SetFocalPoint(to.data());
  camera->SetViewUp(upright.data());
  float far_m = distance_ * 2 + 4;
  if (!scene.isEmpty())
    far_m = std::max(far_m, (scene.center() - eye()).norm() + scene.diagonal().norm() + 4);
  camera->SetClippingRange(std::max(0.02, 0.002 * static_cast<double>(far_m)), static_cast<double>(far_m));
}

}  // namespace scantrove
