#include "core/synthetic/lathe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/check.h"

namespace scantrove::synthetic {
namespace {
constexpr double kSeam_m = 1e-9;  // pieces overlap by this, so that no ray slips between them
}

Lathe::Lathe(const Profile& profile) {
  SCANTROVE_CHECK(profile.size() >= 2);
  z_low_ = z_high_ = profile.front().y();
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Eigen::Vector2d step = profile[i + 1] - profile[i];
    if (step.norm() < 1e-7) {
      continue;
    }
    Piece piece;
    piece.from = profile[i];
    piece.to = profile[i + 1];
    piece.normal = Eigen::Vector2d(step.y(), -step.x()).normalized();
    piece.normal_from = piece.normal_to = piece.normal;
    piece.flat = std::abs(step.y()) < 1e-7;
    piece.slope = piece.flat ? 0 : step.x() / step.y();
    piece.z_low = std::min(piece.from.y(), piece.to.y()) - kSeam_m;
    piece.z_high = std::max(piece.from.y(), piece.to.y()) + kSeam_m;
    piece.arc = length_;
    length_ += step.norm();
    radius_ = std::max({radius_, piece.from.x(), piece.to.x()});
    z_low_ = std::min(z_low_, piece.z_low);
    z_high_ = std::max(z_high_, piece.z_high);
    pieces_.push_back(piece);
  }
  const double cos_crease = std::cos(50.0 / 180.0 * std::numbers::pi);
  for (std::size_t i = 0; i + 1 < pieces_.size(); ++i) {
    if (pieces_[i].normal.dot(pieces_[i + 1].normal) > cos_crease) {
      const Eigen::Vector2d middle = (pieces_[i].normal + pieces_[i + 1].normal).normalized();
      pieces_[i].normal_to = pieces_[i + 1].normal_from = middle;
    }
  }
}

Bounds Lathe::bounds() const { return {{-radius_, -radius_, z_low_}, {radius_, radius_, z_high_}}; }

ShapeHit Lathe::intersect(const Ray& ray, double t_max) const {
  const auto [enter, leave] = bounds().crossing(ray, t_max);
  if (!(enter < leave)) {
    return {};
  }
  const Vec3& d = ray.direction;
  const Vec3 o = ray.at(enter);  // near the solid: the quadratics stay well conditioned
  const double plane_a = d.x() * d.x() + d.y() * d.y();
  const double plane_b = o.x() * d.x() + o.y() * d.y();
  const double plane_c = o.x() * o.x() + o.y() * o.y();
  if (plane_b * plane_b < plane_a * (plane_c - radius_ * radius_)) {
    return {};
  }
  const double z_far = o.z() + d.z() * (leave - enter);
  const double ray_low = std::min(o.z(), z_far) - kSeam_m;
  const double ray_high = std::max(o.z(), z_far) + kSeam_m;
  ShapeHit best{leave - enter, -1};
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    if (piece.z_low > ray_high || piece.z_high < ray_low) {
      continue;
    }
    const auto offer = [&](double t) {
      if (t > 0 && t < best.t) {
        best = {t, static_cast<int>(i)};
      }
    };
    if (piece.flat) {
      const double t = (piece.from.y() - o.z()) / d.z();
      const double radius2 = plane_c + t * (2 * plane_b + t * plane_a);
      const double inner = std::min(piece.from.x(), piece.to.x()) - kSeam_m;
      const double outer = std::max(piece.from.x(), piece.to.x()) + kSeam_m;
      if (radius2 <= outer * outer && (inner <= 0 || radius2 >= inner * inner)) {
        offer(t);
      }
      continue;
    }
    const double radius_at_o = piece.from.x() + piece.slope * (o.z() - piece.from.y());
    const double radius_rate = piece.slope * d.z();
    const double a = plane_a - radius_rate * radius_rate;
    const double b = plane_b - radius_rate * radius_at_o;
    const double c = plane_c - radius_at_o * radius_at_o;
    const auto offerOnPiece = [&](double t) {
      const double z = o.z() + t * d.z();
      if (z >= piece.z_low && z <= piece.z_high && radius_at_o + t * radius_rate >= 0) {
        offer(t);
      }
    };
    const double root = b * b - a * c;
    if (std::abs(a) < 1e-12) {
      offerOnPiece(-c / (2 * b));
    } else if (root >= 0) {
      const double q = -(b + std::copysign(std::sqrt(root), b));
      offerOnPiece(q / a);
      offerOnPiece(c / q);
    }
  }
  return best.part < 0 ? ShapeHit{} : ShapeHit{best.t + enter, best.part};
}

SurfacePoint Lathe::describe(const Vec3& point, int part) const {
  const Piece& piece = pieces_[static_cast<std::size_t>(part)];
  const double ring = lengthOf(point.x(), point.y());
  const double cos_around = ring > 0 ? point.x() / ring : 1;
  const double sin_around = ring > 0 ? point.y() / ring : 0;
  const Eigen::Vector2d step = piece.to - piece.from;
  const double along =
      std::clamp((Eigen::Vector2d(ring, point.z()) - piece.from).dot(step) / step.squaredNorm(), 0.0, 1.0);
  const auto turn = [&](const Eigen::Vector2d& n) {
    return Vec3(n.x() * cos_around, n.x() * sin_around, n.y());
  };

  SurfacePoint surface;
  surface.point = point;
  surface.normal = turn(piece.normal);
  surface.shading_normal = turn(((1 - along) * piece.normal_from + along * piece.normal_to).normalized());
  const double around = std::atan2(point.y(), point.x());
  const double arc = piece.arc + along * step.norm();
  surface.u = static_cast<float>(around * radius_);
  surface.v = static_cast<float>(arc);
  surface.ru = static_cast<float>(around / std::numbers::pi);
  surface.rv = static_cast<float>(2 * (point.z() - z_low_) / (z_high_ - z_low_) - 1);
  return surface;
}

double Lathe::reach(const Vec3& direction) const {
  const double outwards = lengthOf(direction.x(), direction.y());
  double reach = -kNoHit;
  for (const Piece& piece : pieces_) {
    for (const Eigen::Vector2d& end : {piece.from, piece.to}) {
      reach = std::max(reach, outwards * end.x() + direction.z() * end.y());
    }
  }
  return reach;
}

void appendArc(Lathe::Profile& profile, Eigen::Vector2d center, double radius, double from_deg, double to_deg,
               int steps) {
  for (int i = 0; i <= steps; ++i) {
    const double angle = (from_deg + (to_deg - from_deg) * i / steps) / 180.0 * std::numbers::pi;
    profile.emplace_back(std::max(0.0, center.x() + radius * std::cos(angle)),
                         center.y() + radius * std::sin(angle));
  }
}

Lathe::Profile canProfile(double bottom_radius, double top_radius, double height, double rim) {
  Lathe::Profile profile{{0, 0}};
  appendArc(profile, {bottom_radius - rim, rim}, rim, -90, 0, 3);
  appendArc(profile, {top_radius - rim, height - rim}, rim, 0, 90, 3);
  profile.emplace_back(0, height);
  return profile;
}

Lathe::Profile vesselProfile(const Lathe::Profile& outer, double wall) {
  Lathe::Profile profile{{0, outer.front().y()}};
  profile.insert(profile.end(), outer.begin(), outer.end());
  const Eigen::Vector2d& rim = outer.back();
  appendArc(profile, {rim.x() - wall / 2, rim.y()}, wall / 2, 0, 180, 6);
  for (auto p = outer.rbegin(); p != outer.rend(); ++p) {
    const double floor_z = outer.front().y() + wall;
    profile.emplace_back(std::max(0.0, p->x() - wall), std::max(p->y(), floor_z));
  }
  profile.emplace_back(0, outer.front().y() + wall);
  return profile;
}

Lathe::Profile smoothProfile(const Lathe::Profile& knots, int steps) {
  Lathe::Profile profile;
  const auto knot = [&](std::ptrdiff_t i) {
    return knots[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, std::ssize(knots) - 1))];
  };
  for (std::ptrdiff_t i = 0; i + 1 < std::ssize(knots); ++i) {
    for (int s = 0; s < steps; ++s) {
      const double x = static_cast<double>(s) / steps;
      const Eigen::Vector2d p0 = knot(i - 1), p1 = knot(i), p2 = knot(i + 1), p3 = knot(i + 2);
      Eigen::Vector2d p = 0.5 * (2 * p1 + (p2 - p0) * x + (2 * p0 - 5 * p1 + 4 * p2 - p3) * x * x +
                                 (3 * p1 - p0 - 3 * p2 + p3) * x * x * x);
      p.x() = std::max(p.x(), 0.0);
      profile.push_back(p);
    }
  }
  profile.push_back(knots.back());
  return profile;
}

}  // namespace scantrove::synthetic
