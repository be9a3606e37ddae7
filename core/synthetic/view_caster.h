#pragma once
#include <cstdint>
#include <vector>

#include "core/synthetic/scene.h"

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

/// Casts the rays of one view quickly. Every image tile lists the few parts visible in it, nearest first.
/// Rays are linear in (u, v) in each part's own frame.
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
  /// The nearest hit, on parts of all instances but `ignored`.
  [[nodiscard]] Hit cast(int u, int v, std::uint16_t ignored = 0) const;
  /// The hit point in its part's frame.
  [[nodiscard]] Vec3 localPoint(const Hit& hit, int u, int v) const;

 private:
  struct LinearRays {  // origin and direction of the ray of (u, v): base + u * per_u + v * per_v
    Vec3 origin, origin_u, origin_v;
    Vec3 direction, direction_u, direction_v;
    [[nodiscard]] Ray at(double u, double v, bool parallel) const {
      return parallel ? Ray{origin + u * origin_u + v * origin_v, direction}
                      : Ray{origin, direction + u * direction_u + v * direction_v};
    }
  };
  struct Candidate {
    std::uint16_t part;
    std::uint16_t instance;
    double nearest_z;  // no ray of the tile hits the part's bounds before this depth
  };
  /// Tiles that the projected corners of the part's bounds may cover: first and last of x and y.
  [[nodiscard]] Eigen::Array4i tilesOf(const Bounds& bounds, const Eigen::Isometry3d& T_view_part) const;
  [[nodiscard]] std::pair<double, double> depthRange(const LinearRays& rays, const Bounds& bounds, int tile_x,
                                                     int tile_y) const;

  [[nodiscard]] std::size_t tileIndex(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(tiles_x_) + static_cast<std::size_t>(x);
  }

  static constexpr int kTile = 16;
  const SyntheticScene& scene_;
  View view_;
  int tiles_x_, tiles_y_;
  std::vector<LinearRays> rays_;               // for each part
  std::vector<std::vector<Candidate>> tiles_;  // nearest first
};

}  // namespace scantrove::synthetic
