#pragma once
#include <array>
#include <memory>

#include "core/synthetic/scene.h"

namespace scantrove::synthetic {

/// A skin of gentle bumps, as paint, cloth and crumpled cardboard have: the solid's surface lies a little
/// below that of `base`, measured along its normal, in waves around `wavelength_m`; from top to bottom about
/// `bumps_m`. The same from every direction but where the surface is seen at a grazing angle and within
/// `bumps_m` of sharp edges.
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

/// The same scene with bumps of 2 - 5 mm, 3 - 13 cm long, on walls, floor and all that is thick enough, other
/// ones on each thing; what is turned (cans, bottles, vases) stays smooth.
[[nodiscard]] SyntheticScene makeBumpy(SyntheticScene scene, std::uint32_t seed);

}  // namespace scantrove::synthetic
