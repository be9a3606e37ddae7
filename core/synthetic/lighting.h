#pragma once
#include <vector>

#include "core/synthetic/scene.h"

namespace scantrove::synthetic {

/// A window's warm light from one side with soft shadows, and the room's own light, darker in corners and
/// under things. Both are baked once for the whole (static) scene.
class Lighting {
 public:
  /// Shadows reach `radius` metres around `centre`; beyond, everything is lit.
  Lighting(const SyntheticScene& scene, const Vec3& center, double radius);

  /// How much of the room's light arrives at a surface point, 0..1: little in corners and under things.
  /// Changes slowly along a surface.
  [[nodiscard]] float openness(const Vec3& point, const Vec3& normal) const;

  /// Light that leaves a surface point towards the eye. World frame, unit vectors, `to_eye` away from the
  /// surface.
  [[nodiscard]] Rgb shade(const Vec3& point, const Vec3& normal, const Vec3& to_eye, const Rgb& albedo,
                          float gloss, float openness) const;

 private:
  /// A square depth image seen from above or from the light.
  struct DepthMap {
    Eigen::Isometry3d T_map_world;
    double texels_per_meter = 1;
    int size = 0;
    std::vector<float> z;
    [[nodiscard]] float at(int x, int y) const;  // far away outside
  };
  static DepthMap bake(const SyntheticScene& scene, const Vec3& center, const Vec3& to_light, double radius,
                       int size);
  static DepthMap highestWithin(const DepthMap& map, double radius);
  [[nodiscard]] float sunlit(const Vec3& point) const;

  Vec3 to_light_;
  DepthMap from_light_;
  DepthMap from_above_;
  DepthMap first_lit_;  ///< what the light meets first around each texel of from_light_
  DepthMap tops_;       ///< the highest thing around each texel: above it, nothing blocks the sky
};

}  // namespace scantrove::synthetic
