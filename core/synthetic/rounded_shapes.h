#pragma once
#include "core/synthetic/shape.h"

namespace scantrove::synthetic {

/// A box around the origin whose edges are rounded with `radius` (0 = sharp). Flat faces are intersected
/// exactly, rounded edges by sphere tracing to a micrometre.
class RoundedBox final : public Shape {
 public:
  RoundedBox(const Vec3& half_size, double radius);
  [[nodiscard]] Bounds bounds() const override { return {-half_, half_}; }
  [[nodiscard]] ShapeHit intersect(const Ray& ray, double t_max) const override;
  [[nodiscard]] SurfacePoint describe(const Vec3& point, int part) const override;
  [[nodiscard]] double reach(const Vec3& direction) const override;
  [[nodiscard]] double thickness() const override { return 2 * half_.minCoeff(); }

 private:
  Vec3 half_;
  Vec3 inner_;
  double radius_;
};

class Sphere final : public Shape {
 public:
  explicit Sphere(double radius) : radius_(radius) {}
  [[nodiscard]] Bounds bounds() const override { return {Vec3::Constant(-radius_), Vec3::Constant(radius_)}; }
  [[nodiscard]] ShapeHit intersect(const Ray& ray, double t_max) const override;
  [[nodiscard]] SurfacePoint describe(const Vec3& point, int part) const override;
  [[nodiscard]] double reach(const Vec3& direction) const override;
  [[nodiscard]] double thickness() const override { return 2 * radius_; }

 private:
  double radius_;
};

/// A ring around the z axis, cut flat to the part with y >= `keep_above` (-infinity: the complete ring).
/// Sphere traced to a micrometre.
class Torus final : public Shape {
 public:
  Torus(double ring_radius, double tube_radius, double keep_above = -kNoHit);
  [[nodiscard]] Bounds bounds() const override;
  [[nodiscard]] ShapeHit intersect(const Ray& ray, double t_max) const override;
  [[nodiscard]] SurfacePoint describe(const Vec3& point, int part) const override;
  [[nodiscard]] double reach(const Vec3& direction) const override;

 private:
  [[nodiscard]] double tubeDistance(const Vec3& point) const;
  double ring_radius_;
  double tube_radius_;
  double keep_above_;
};

}  // namespace scantrove::synthetic
