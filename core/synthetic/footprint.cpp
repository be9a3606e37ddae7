#include "core/synthetic/footprint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace scantrove::synthetic {
namespace {

using Eigen::Vector2d;

Vector2d rotated(const Vector2d& p, double yaw_deg) {
  const double angle = yaw_deg / 180 * std::numbers::pi;
  return {p.x() * std::cos(angle) - p.y() * std::sin(angle),
          p.x() * std::sin(angle) + p.y() * std::cos(angle)};
}

std::array<Vector2d, 4> corners(const Footprint& f) {
  std::array<Vector2d, 4> result;
  const double signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (std::size_t i = 0; i < 4; ++i) {
    result[i] = f.center + rotated({signs[i][0] * f.half.x(), signs[i][1] * f.half.y()}, f.yaw_deg);
  }
  return result;
}

/// Distance of a point from the rectangle (without rounding); 0 inside.
double outside(const Footprint& f, const Vector2d& point) {
  const Vector2d local = rotated(point - f.center, -f.yaw_deg).cwiseAbs() - f.half;
  return local.cwiseMax(0.0).norm();
}

/// Whether an axis of `a` separates the two rectangles.
bool separatedBy(const Footprint& a, const std::array<Vector2d, 4>& b) {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high = -low;
  for (const Vector2d& corner : b) {
    const Vector2d local = rotated(corner - a.center, -a.yaw_deg);
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
  }
  return (low.array() > a.half.array()).any() || (high.array() < -a.half.array()).any();
}

}  // namespace

Footprint Footprint::placedAt(double x, double y, double yaw) const {
  return {Vector2d(x, y) + rotated(center, yaw), half, yaw_deg + yaw, round};
}

double distance(const Footprint& a, const Footprint& b) {
  const auto corners_a = corners(a);
  const auto corners_b = corners(b);
  if (!separatedBy(a, corners_b) && !separatedBy(b, corners_a)) {
    return -std::numeric_limits<double>::infinity();
  }
  double nearest = std::numeric_limits<double>::infinity();  // the minimum distance of two rectangles is at a
                                                             // corner of one
  for (std::size_t i = 0; i < 4; ++i) {
    nearest = std::min({nearest, outside(a, corners_b[i]), outside(b, corners_a[i])});
  }
  return nearest - a.round - b.round;
}

bool contains(const Footprint& outer, const Footprint& inner) {
  for (const Vector2d& corner : corners(inner)) {
    const Vector2d local = rotated(corner - outer.center, -outer.yaw_deg).cwiseAbs();
    if (((local.array() + inner.round) > outer.half.array() + 1e-9).any()) return false;
  }
  return true;
}

double distance(const Eigen::Vector3d& point, const Volume& volume) {
  const double aside = std::max(0.0, outside(volume.base, point.head<2>()) - volume.base.round);
  const double above = std::max({0.0, volume.z_low - point.z(), point.z() - volume.z_high});
  return std::hypot(aside, above);
}

}  // namespace scantrove::synthetic
