#pragma once
#include <cstdint>
#include <vector>

#include "core/capture/synthetic/scene.h"

namespace scantrove::synthetic {

/// A camera or a light that looks along +z of its frame. Pixel (u, v) is at u = fx x / z + cx (a parallel
/// view: u = fx x + cx).
struct View {
  Eigen::Isometry3d T_world_view = Eigen::Isometry3d::Identity();
  double fx = 1, fy = 1, cx = 0, cy = 0;
  int width = 0, height = 0;
  bool parallel = false;
  bool shadow_casters_only = false;
};

/// Casts the rays of one view quickly: every tile of the image knows the few parts that can be seen in it,
/// nearest first, and rays are linear in (u, v) in each part's own frame.
class ViewCaster {
 public:
  struct Hit {
    double z = kNoHit;  ///< depth along the view's z axis
    int part = -1;      ///< index into SyntheticScene::parts(), -1 = nothing
    int piece = 0;      ///< for Shape::describe
    [[nodiscard]] explicit operator bool() const { return part >= 0; }
  };

  /// Keeps a reference to the scene.
  ViewCaster(const SyntheticScene& scene, const View& view);
  [[nodiscard]] Hit cast(double u, double v) const;
  /// The hit point in its part's frame.
  [[nodiscard]] Vec3 localPoint(const Hit& hit, double u, double v) const;

 private:
  struct LinearRays {  // origin and direction of the ray of (u, v): base + u * per_u + v * per_v
    Vec3 origin, origin_u, origin_v;
    Vec3 direction, direction_u, direction_v;
    [[nodiscard]] Ray at(double u, double v) const {
      return {origin + u * origin_u + v * origin_v, direction + u * direction_u + v * direction_v};
    }
  };
  void addToTiles(std::uint16_t part, const Bounds& bounds, const Eigen::Isometry3d& T_view_part);

  static constexpr int kTile = 16;
  const SyntheticScene& scene_;
  View view_;
  int tiles_x_, tiles_y_;
  std::vector<LinearRays> rays_;                   // for each part
  std::vector<double> nearest_z_;                  // for each part
  std::vector<std::vector<std::uint16_t>> tiles_;  // parts, by nearest_z_
};

}  // namespace scantrove::synthetic
