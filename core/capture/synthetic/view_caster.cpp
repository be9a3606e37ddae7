#include "core/capture/synthetic/view_caster.h"

#include <algorithm>
#include <cmath>

namespace scantrove::synthetic {
namespace {
constexpr double kNear_m = 0.05;
}

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
  for (std::size_t i = 0; i < scene.parts().size(); ++i) {
    const SyntheticScene::Part& part = scene.parts()[i];
    const Eigen::Isometry3d T_part_view = part.T_world_part.inverse() * view.T_world_view;
    const Eigen::Matrix3d R = T_part_view.linear();
    LinearRays rays;
    const Vec3 zero = Vec3::Zero();
    if (view.parallel) {
      rays = {T_part_view * base, R * per_u, R * per_v, R.col(2), zero, zero};
    } else {
      rays = {T_part_view.translation(), zero, zero, R * (base + Vec3::UnitZ()), R * per_u, R * per_v};
    }
    rays_.push_back(rays);
    nearest_z_.push_back(0);
    if (view.shadow_casters_only && !part.material.casts_shadow) {
      continue;
    }
    addToTiles(static_cast<std::uint16_t>(i), part.shape->bounds(), T_part_view.inverse());
  }
  for (auto& tile : tiles_) {
    std::stable_sort(tile.begin(), tile.end(),
                     [this](std::uint16_t a, std::uint16_t b) { return nearest_z_[a] < nearest_z_[b]; });
  }
}

void ViewCaster::addToTiles(std::uint16_t part, const Bounds& bounds, const Eigen::Isometry3d& T_view_part) {
  Eigen::Array2d low(view_.width, view_.height);
  Eigen::Array2d high(-1, -1);
  double nearest = kNoHit;
  double farthest = -kNoHit;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p = T_view_part * Vec3((corner & 1) != 0 ? bounds.high.x() : bounds.low.x(),
                                      (corner & 2) != 0 ? bounds.high.y() : bounds.low.y(),
                                      (corner & 4) != 0 ? bounds.high.z() : bounds.low.z());
    nearest = std::min(nearest, p.z());
    farthest = std::max(farthest, p.z());
    const double scale = view_.parallel ? 1 : 1 / std::max(p.z(), kNear_m);
    const Eigen::Array2d pixel(view_.fx * p.x() * scale + view_.cx, view_.fy * p.y() * scale + view_.cy);
    low = low.min(pixel);
    high = high.max(pixel);
  }
  if (farthest <= 0) {
    return;
  }
  nearest_z_[part] = std::max(nearest, 0.0);
  if (!view_.parallel && nearest < kNear_m) {  // reaches behind the camera: may be seen anywhere
    low = {0, 0};
    high = {view_.width - 1, view_.height - 1};
  }
  const auto tile = [](double pixel, int tiles) {
    return static_cast<int>(std::clamp(std::floor(pixel / kTile), -1.0, static_cast<double>(tiles)));
  };
  const int x_end = std::min(tile(high.x(), tiles_x_), tiles_x_ - 1);
  const int y_end = std::min(tile(high.y(), tiles_y_), tiles_y_ - 1);
  for (int y = std::max(tile(low.y(), tiles_y_), 0); y <= y_end; ++y) {
    for (int x = std::max(tile(low.x(), tiles_x_), 0); x <= x_end; ++x) {
      tiles_[static_cast<std::size_t>(y * tiles_x_ + x)].push_back(part);
    }
  }
}

ViewCaster::Hit ViewCaster::cast(double u, double v) const {
  const int tile = static_cast<int>(v) / kTile * tiles_x_ + static_cast<int>(u) / kTile;
  Hit best;
  for (const std::uint16_t part : tiles_[static_cast<std::size_t>(tile)]) {
    if (nearest_z_[part] >= best.z) {
      break;
    }
    const ShapeHit hit = scene_.parts()[part].shape->intersect(rays_[part].at(u, v), best.z);
    if (hit.t < best.z) {
      best = {hit.t, part, hit.part};
    }
  }
  return best;
}

Vec3 ViewCaster::localPoint(const Hit& hit, double u, double v) const {
  return rays_[static_cast<std::size_t>(hit.part)].at(u, v).at(hit.z);
}

}  // namespace scantrove::synthetic
