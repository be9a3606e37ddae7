#pragma once
#include <optional>
#include <vector>

#include "core/synthetic/scene.h"

namespace scantrove::synthetic {

/// Lights of a scene, in its world frame.
struct Lights {
  Vec3 to_sun = Vec3(-0.50, -0.42, 0.86);  ///< direction of the window light; need not have unit length
  std::optional<Vec3> lamp = {};           ///< lights nothing up, but glossy surfaces mirror it
};

/// Window light 35 - 60 degrees above the horizon, from any side, and a lamp over `center`.
[[nodiscard]] Lights makeRandomLights(std::uint32_t seed, const Vec3& center);

/// Warm window light from one side with soft shadows, and ambient light, darker in corners and under things.
/// Both are baked once for the whole (static) scene.
class Lighting {
 public:
  /// Shadows cover `radius` metres around `centre`; everything beyond is lit.
  Lighting(const SyntheticScene& scene, const Vec3& center, double radius, const Lights& lights = {});

  /// Ambient light at a surface point, 0..1: little in corners and under things. Varies slowly along a
  /// surface.
  [[nodiscard]] float openness(const Vec3& point, const Vec3& normal) const;

  /// Light reflected from a surface point towards the eye. World frame, unit vectors; `to_eye` points away
  /// from the surface. `material` gives the highlights, `albedo` the rest.
  [[nodiscard]] Rgb shade(const Vec3& point, const Vec3& normal, const Vec3& to_eye, const Rgb& albedo,
                          const Material& material, float openness) const;

 private:
  /// A square depth image seen from above or from the light.
  struct DepthMap {
    Eigen::Isometry3d T_map_world;
    double texels_per_meter = 1;
    int size = 0;
    std::vector<float> z;
    [[nodiscard]] float at(int x, int y) const;  // infinitely far outside the map
  };
  static DepthMap bake(const SyntheticScene& scene, const Vec3& center, const Vec3& to_light, double radius,
                       int size);
  static DepthMap highestWithin(const DepthMap& map, double radius);
  [[nodiscard]] float sunlit(const Vec3& point) const;

  Vec3 to_light_;
  std::optional<Vec3> lamp_;
  DepthMap from_light_;
  DepthMap from_above_;
  DepthMap first_lit_;  ///< first lit surface around each texel of from_light_
  DepthMap tops_;       ///< highest surface around each texel; nothing above it blocks the sky
};

}  // namespace scantrove::synthetic
