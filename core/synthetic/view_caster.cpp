#include "core/synthetic/view_caster.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scantrove::synthetic {
namespace {
constexpr double kNear_m = 0.05;

Vec3 corner(const Bounds& bounds, int i) {
  return {(i & 1) != 0 ? bounds.high.x() : bounds.low.x(), (i & 2) != 0 ? bounds.high.y() : bounds.low.y(),
          (i & 4) != 0 ? bounds.high.z() : bounds.low.z()};
}
}  // namespace

ViewCaster::ViewCaster(const SyntheticScene& scene, const View& view)
    : scene_(scene),
      view_(view),
      tiles_x_((view.width + kTile - 1) / kTile),
      tiles_y_((view.height + kTile - 1) / kTile),
      tiles_(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_)) {
  // In the view's frame: the point or direction of (u, v) at z = 1 is ((u - cx) / fx, (v - cy) / fy, 1).
  const Vec3 base(-view.cx / view.fx, -view.cy / view.fy, 0);
  const Vec3 per_u(1 / view.fx, 0, 0);
  const Vec3 per_v(0, 1 / view.fy, 0);
  const Vec3 zero = Vec3::Zero();
  for (std::size_t i = 0; i < scene.parts().size(); ++i) {
    const SyntheticScene::Part& part = scene.parts()[i];
    const Eigen::Isometry3d T_part_view = part.T_world_part.inverse() * view.T_world_view;
    const Eigen::Matrix3d R = T_part_view.linear();
    LinearRays rays;
    if (view.parallel) {
      rays = {T_part_view * base, R * per_u, R * per_v, R.col(2), zero, zero};
    } else {
      rays = {T_part_view.translation(), zero, zero, R * (base + Vec3::UnitZ()), R * per_u, R * per_v};
    }
    rays_.push_back(rays);
    if (view.shadow_casters_only && !part.material.casts_shadow) {
      continue;
    }
    const Bounds bounds = part.shape->bounds();
    const Eigen::Array4i seen = tilesOf(bounds, T_part_view.inverse());
    for (int y = seen[2]; y <= seen[3]; ++y) {
      for (int x = seen[0]; x <= seen[1]; ++x) {
        const auto [nearest, farthest] = depthRange(rays, bounds, x, y);
        if (nearest <= farthest) {
          tiles_[tileIndex(x, y)].push_back({static_cast<std::uint16_t>(i), part.instance, nearest});
        }
      }
    }
  }
  for (auto& tile : tiles_) {
    std::stable_sort(tile.begin(), tile.end(),
                     [](const Candidate& a, const Candidate& b) { return a.nearest_z < b.nearest_z; });
  }
}

Eigen::Array4i ViewCaster::tilesOf(const Bounds& bounds, const Eigen::Isometry3d& T_view_part) const {
  Eigen::Array2d low(kNoHit, kNoHit);
  Eigen::Array2d high(-kNoHit, -kNoHit);
  const auto include = [&](const Vec3& p) {
    const double scale = view_.parallel ? 1 : 1 / p.z();
    const Eigen::Array2d pixel(view_.fx * p.x() * scale + view_.cx, view_.fy * p.y() * scale + view_.cy);
    low = low.min(pixel);
    high = high.max(pixel);
  };
  for (int i = 0; i < 8; ++i) {
    const Vec3 p = T_view_part * corner(bounds, i);
    if (p.z() >= kNear_m) {
      include(p);
    }
    for (const int bit : {1, 2, 4}) {  // where edges pierce the near plane
      const Vec3 q = T_view_part * corner(bounds, i | bit);
      if ((p.z() < kNear_m) != (q.z() < kNear_m)) {
        include(p + (q - p) * ((kNear_m - p.z()) / (q.z() - p.z())));
      }
    }
  }
  const auto tile = [](double pixel, int tiles) {
    return static_cast<int>(std::clamp(std::floor(pixel / kTile), -1.0, static_cast<double>(tiles)));
  };
  return {std::max(tile(low.x() - 1, tiles_x_), 0), std::min(tile(high.x() + 1, tiles_x_), tiles_x_ - 1),
          std::max(tile(low.y() - 1, tiles_y_), 0), std::min(tile(high.y() + 1, tiles_y_), tiles_y_ - 1)};
}

std::pair<double, double> ViewCaster::depthRange(const LinearRays& rays, const Bounds& bounds, int tile_x,
                                                 int tile_y) const {
  // Where all rays of the tile have the same sign along an axis, the depth of a face crossing lies between
  // those of the corner rays. Origin and direction are linear in u and v, and one of them is constant.
  std::array<Ray, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = rays.at(tile_x * kTile + ((i & 1) != 0 ? kTile - 1 : 0),
                         tile_y * kTile + ((i & 2) != 0 ? kTile - 1 : 0), view_.parallel);
  }
  double nearest = 0;
  double farthest = kNoHit;
  for (int axis = 0; axis < 3; ++axis) {
    double enter = kNoHit;
    double leave = -kNoHit;
    const bool forward = corners[0].direction[axis] > 0;
    bool same_way = true;
    for (const Ray& ray : corners) {
      const double d = ray.direction[axis];
      same_way = same_way && (d > 0) == forward && std::abs(d) > 1e-12;
      const double first = forward ? bounds.low[axis] : bounds.high[axis];
      const double second = forward ? bounds.high[axis] : bounds.low[axis];
      enter = std::min(enter, (first - ray.origin[axis]) / d);
      leave = std::max(leave, (second - ray.origin[axis]) / d);
    }
    if (same_way) {
      nearest = std::max(nearest, enter);
      farthest = std::min(farthest, leave);
    }
  }
  constexpr double kRounding = 1e-9;
  return {nearest - kRounding, farthest + kRounding};
}

ViewCaster::Hit ViewCaster::cast(int u, int v, std::uint16_t ignored) const {
  Hit best;
  for (const Candidate& candidate : tiles_[tileIndex(u / kTile, v / kTile)]) {
    if (candidate.nearest_z >= best.z) {
      break;
    }
    if (candidate.instance == ignored) {
      continue;
    }
    const ShapeHit hit = scene_.parts()[candidate.part].shape->intersect(
        rays_[candidate.part].at(u, v, view_.parallel), best.z);
    if (hit.t < best.z) {
      best = {hit.t, candidate.part, hit.part};
    }
  }
  return best;
}

Vec3 ViewCaster::localPoint(const Hit& hit, int u, int v) const {
  return rays_[static_cast<std::size_t>(hit.part)].at(u, v, view_.parallel).at(hit.z);
}

}  // namespace scantrove::synthetic
