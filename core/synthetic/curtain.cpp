#include "core/synthetic/curtain.h"

#include <numbers>

#include "core/synthetic/sphere_tracing.h"

namespace scantrove::synthetic {
namespace {
constexpr double kSecondWave =
    0.35;  // relative height of the second wave, 1.62 times as long, so that folds differ
constexpr double kSecondLength = 1.62;
}  // namespace

Curtain::Curtain(const Vec3& size, double thickness, double folds)
    : half_(size / 2),
      half_thickness_(thickness / 2),
      amplitude_((half_.y() - half_thickness_) / (1 + kSecondWave)),
      per_meter_(2 * std::numbers::pi * folds / size.x()),
      steepest_(lengthOf(1.0, amplitude_ * per_meter_ * (1 + kSecondWave / kSecondLength))) {}

double Curtain::wave(double x) const {
  const double angle = per_meter_ * x;
  return amplitude_ * (std::sin(angle) + kSecondWave * std::sin(angle / kSecondLength + 1));
}

double Curtain::slope(double x) const {
  const double angle = per_meter_ * x;
  return amplitude_ * per_meter_ *
         (std::cos(angle) + kSecondWave / kSecondLength * std::cos(angle / kSecondLength + 1));
}

ShapeHit Curtain::intersect(const Ray& ray, double t_max) const {
  const auto [enter, leave] = bounds().crossing(ray, t_max);
  if (!(enter < leave)) {
    return {};
  }
  return {march(ray, enter, leave,
                [this](const Vec3& p) {
                  const double to_sheet = (std::abs(p.y() - wave(p.x())) - half_thickness_) / steepest_;
                  return std::max({to_sheet, std::abs(p.x()) - half_.x(), std::abs(p.z()) - half_.z()});
                }),
          0};
}

SurfacePoint Curtain::describe(const Vec3& point, int /*part*/) const {
  SurfacePoint surface;
  surface.point = point;
  const double aside = point.y() - wave(point.x());
  const Vec3 edge = point.cwiseAbs() - half_;
  if (std::abs(aside) < half_thickness_ - 1e-5 && edge.x() < -1e-5) {
    surface.normal = Vec3::UnitZ() * (point.z() > 0 ? 1 : -1);
  } else if (edge.x() >= -1e-5) {
    surface.normal = Vec3::UnitX() * (point.x() > 0 ? 1 : -1);
  } else {
    surface.normal = Vec3(-slope(point.x()), 1, 0).normalized() * (aside > 0 ? 1 : -1);
  }
  surface.shading_normal = surface.normal;
  surface.u = static_cast<float>(point.x());
  surface.v = static_cast<float>(point.z());
  surface.ru = static_cast<float>(point.x() / half_.x());
  surface.rv = static_cast<float>(point.z() / half_.z());
  surface.face = aside > 0 ? 3 : 2;
  return surface;
}

}  // namespace scantrove::synthetic
