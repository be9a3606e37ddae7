#pragma once
#include "core/synthetic/shape.h"

namespace scantrove::synthetic {

/// A hanging cloth of `size` (x, y, z) around the origin: a sheet of `thickness` with `folds` waves in y
/// along x. Sphere traced to a micrometre.
class Curtain final : public Shape {
 public:
  Curtain(const Vec3& size, double thickness, double folds);
  [[nodiscard]] Bounds bounds() const override { return {-half_, half_}; }
  [[nodiscard]] ShapeHit intersect(const Ray& ray, double t_max) const override;
  [[nodiscard]] SurfacePoint describe(const Vec3& point, int part) const override;
  [[nodiscard]] double reach(const Vec3& direction) const override { return direction.cwiseAbs().dot(half_); }

 private:
  [[nodiscard]] double wave(double x) const;
  [[nodiscard]] double slope(double x) const;
  Vec3 half_;
  double half_thickness_;
  double amplitude_;
  double per_meter_;  // radians
  double steepest_;   // maximum length of the normal (slope, 1)
};

}  // namespace scantrove::synthetic
