#include "core/synthetic/rounded_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/synthetic/sphere_tracing.h"

namespace scantrove::synthetic {

RoundedBox::RoundedBox(const Vec3& half_size, double radius)
    : half_(half_size),
      inner_(half_size.array() - std::min(radius, half_size.minCoeff())),
      radius_(std::min(radius, half_size.minCoeff())) {}

ShapeHit RoundedBox::intersect(const Ray& ray, double t_max) const {
  const auto [enter, leave] = bounds().crossing(ray, t_max);
  if (!(enter < leave) || enter <= 0) {
    return {};
  }
  const Vec3 point = ray.at(enter);
  const Vec3 outside = (point.cwiseAbs() - inner_).cwiseMax(0.0);
  if (radius_ == 0 || (outside.array() > 0).count() <= 1) {
    return {enter, 0};
  }
  return {march(ray, enter, leave,
                [this](const Vec3& p) {
                  const Vec3 q = p.cwiseAbs() - inner_;
                  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - radius_;
                }),
          0};
}

SurfacePoint RoundedBox::describe(const Vec3& point, int /*part*/) const {
  SurfacePoint surface;
  surface.point = point;
  const Vec3 sign = point.array().sign();
  const Vec3 outside = (point.cwiseAbs() - inner_).cwiseMax(0.0);
  int axis = 0;
  if (radius_ > 0 && (outside.array() > 0).count() > 1) {
    surface.normal = outside.normalized().cwiseProduct(sign);
    surface.normal.cwiseAbs().maxCoeff(&axis);
  } else {
    (point.cwiseAbs() - half_).maxCoeff(&axis);
    surface.normal = Vec3::Zero();
    surface.normal[axis] = sign[axis];
  }
  surface.shading_normal = surface.normal;
  const int u_axis = axis == 0 ? 1 : 0;
  const int v_axis = axis == 2 ? 1 : 2;
  surface.u = static_cast<float>(point[u_axis]);
  surface.v = static_cast<float>(point[v_axis]);
  surface.ru = static_cast<float>(point[u_axis] / half_[u_axis]);
  surface.rv = static_cast<float>(point[v_axis] / half_[v_axis]);
  surface.face = 2 * axis + (sign[axis] > 0 ? 1 : 0);
  return surface;
}

double RoundedBox::reach(const Vec3& direction) const { return direction.cwiseAbs().dot(inner_) + radius_; }

ShapeHit Sphere::intersect(const Ray& ray, double t_max) const {
  const double a = ray.direction.squaredNorm();
  const double b = ray.origin.dot(ray.direction);
  const double c = ray.origin.squaredNorm() - radius_ * radius_;
  const double root = b * b - a * c;
  if (!(root > 0)) {
    return {};
  }
  const double t = (-b - std::sqrt(root)) / a;
  return t > 0 && t < t_max ? ShapeHit{t, 0} : ShapeHit{};
}

SurfacePoint Sphere::describe(const Vec3& point, int /*part*/) const {
  SurfacePoint surface;
  surface.point = point;
  surface.normal = point.normalized();
  surface.shading_normal = surface.normal;
  const double angle = std::atan2(point.y(), point.x());
  const double height = std::asin(std::clamp(surface.normal.z(), -1.0, 1.0));
  surface.u = static_cast<float>(angle * radius_);
  surface.v = static_cast<float>(height * radius_);
  surface.ru = static_cast<float>(angle / std::numbers::pi);
  surface.rv = static_cast<float>(height * 2 / std::numbers::pi);
  return surface;
}

double Sphere::reach(const Vec3& /*direction*/) const { return radius_; }

Torus::Torus(double ring_radius, double tube_radius, double keep_above)
    : ring_radius_(ring_radius), tube_radius_(tube_radius), keep_above_(keep_above) {}

Bounds Torus::bounds() const {
  const double outer = ring_radius_ + tube_radius_;
  return {{-outer, std::max(-outer, keep_above_), -tube_radius_}, {outer, outer, tube_radius_}};
}

double Torus::tubeDistance(const Vec3& p) const {
  const double off_ring = lengthOf(p.x(), p.y()) - ring_radius_;
  return lengthOf(off_ring, p.z()) - tube_radius_;
}

ShapeHit Torus::intersect(const Ray& ray, double t_max) const {
  const auto [enter, leave] = bounds().crossing(ray, t_max);
  if (!(enter < leave)) {
    return {};
  }
  return {march(ray, enter, leave,
                [this](const Vec3& p) { return std::max(tubeDistance(p), keep_above_ - p.y()); }),
          0};
}

SurfacePoint Torus::describe(const Vec3& point, int /*part*/) const {
  SurfacePoint surface;
  surface.point = point;
  const double ring = lengthOf(point.x(), point.y());
  const Vec3 center(point.x() / ring * ring_radius_, point.y() / ring * ring_radius_, 0);
  surface.normal = (point - center).normalized();
  if (keep_above_ - point.y() > tubeDistance(point)) {
    surface.normal = -Vec3::UnitY();  // the flat cut
  }
  surface.shading_normal = surface.normal;
  const double around = std::atan2(point.y(), point.x());
  const double along = std::atan2(point.z(), ring - ring_radius_);
  surface.u = static_cast<float>(around * ring_radius_);
  surface.v = static_cast<float>(along * tube_radius_);
  surface.ru = static_cast<float>(around / std::numbers::pi);
  surface.rv = static_cast<float>(along / std::numbers::pi);
  return surface;
}

double Torus::reach(const Vec3& direction) const {
  const double whole = ring_radius_ * lengthOf(direction.x(), direction.y()) + tube_radius_;
  const Bounds box = bounds();
  return std::min(whole, direction.cwiseProduct(box.low).cwiseMax(direction.cwiseProduct(box.high)).sum());
}

}  // namespace scantrove::synthetic
