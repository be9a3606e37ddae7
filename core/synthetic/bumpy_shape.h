#pragma once
#include <array>
#include <memory>

#include "core/synthetic/scene.h"

namespace scantrove::synthetic {

/// Adds gentle bumps like those of paint, cloth and crumpled cardboard. The surface lies slightly below that
/// of `base`, measured along its normal, in waves around `wavelength_m`, about `bumps_m` from peak to valley.
/// It looks the same from all directions, except at grazing angles and within `bumps_m` of sharp edges.
class BumpyShape final : public Shape {
 public:
  BumpyShape(std::unique_ptr<Shape> base, double bumps_m, double wavelength_m, std::uint32_t seed);
  [[nodiscard]] Bounds bounds() const override { return base_->bounds(); }
  [[nodiscard]] ShapeHit intersect(const Ray& ray, double t_max) const override;
  [[nodiscard]] SurfacePoint describe(const Vec3& point, int part) const override;
  [[nodiscard]] double reach(const Vec3& direction) const override { return base_->reach(direction); }

 private:
  struct Wave {
    Eigen::Vector3f per_meter;  // radians
    float phase, height;
  };
  static constexpr std::size_t kWaves = 6;
  [[nodiscard]] double split_off(const Vec3& point) const;
  [[nodiscard]] Vec3 slope(const Vec3& point) const;
  std::unique_ptr<Shape> base_;
  double middle_;
  std::array<Wave, kWaves> waves_;
};

/// The scene with bumps of 2 - 5 mm, 3 - 13 cm long, on walls, floor and all thick enough parts; each thing
/// has its own. Turned shapes (cans, bottles, vases) stay smooth.
[[nodiscard]] SyntheticScene makeBumpy(SyntheticScene scene, std::uint32_t seed);

}  // namespace scantrove::synthetic
