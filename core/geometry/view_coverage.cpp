#include "core/geometry/view_coverage.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace scantrove {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
/// Elevations of a hand-held camera that views a side, and of one that views the top. The gap between them is
/// wider than reach and cell together, so that no view counts as both.
constexpr std::array kHeightsOfSides_deg{-15.0F, 0.0F, 15.0F, 30.0F, 45.0F};
constexpr std::array kHeightsAbove_deg{75.0F, 90.0F};

float radians(float degrees) { return degrees * kPi / 180; }

using Centers = std::array<Eigen::Vector3f, ViewCoverage::kCells>;

/// Centres of the cells: a Fibonacci lattice, points of equal area along a spiral from pole to pole.
const Centers& cellCenters() {
  static const Centers kCenters = [] {
    Centers centers;
    const float golden_angle = kPi * (3 - std::sqrt(5.0F));
    for (std::size_t i = 0; i < centers.size(); ++i) {
      const float z = 1 - (2 * static_cast<float>(i) + 1) / static_cast<float>(centers.size());
      const float around = std::sqrt(1 - z * z);
      const float angle = golden_angle * static_cast<float>(i);
      centers[i] = {around * std::cos(angle), around * std::sin(angle), z};
    }
    return centers;
  }();
  return kCenters;
}

}  // namespace

void ViewCoverage::addDirection(const Eigen::Vector3f& direction) {
  const float length = direction.norm();
  if (!std::isfinite(length) || !(length > 0)) return;
  const float least = std::cos(radians(kReach_deg)) * length;
  const Centers& centers = cellCenters();
  for (std::size_t i = 0; i < centers.size(); ++i) {
    if (centers[i].dot(direction) >= least) cells_.set(i);
  }
}

bool ViewCoverage::covers(const Eigen::Vector3f& direction) const {
  const Centers& centers = cellCenters();
  const auto nearest = std::ranges::max_element(
      centers, {}, [&](const Eigen::Vector3f& center) { return center.dot(direction); });
  return cells_[static_cast<std::size_t>(nearest - centers.begin())];
}

float ViewCoverage::share() const { return static_cast<float>(cells_.count()) / kCells; }

int SeenSides::count() const { return static_cast<int>(std::ranges::count(sides, true)); }

SideAxes SideAxes::of(const Eigen::Vector3f& up, const Eigen::Vector3f& towards) {
  SideAxes axes{up.normalized(), {}};
  axes.front = towards - towards.dot(axes.up) * axes.up;
  if (!(axes.front.norm() > 1e-3F * towards.norm())) axes.front = axes.up.unitOrthogonal();
  axes.front.normalize();
  return axes;
}

Eigen::Vector3f SideAxes::directionOf(std::size_t side, float elevation_deg) const {
  const float angle = 2 * kPi * static_cast<float>(side) / static_cast<float>(SeenSides::kSides);
  const Eigen::Vector3f level = std::cos(angle) * front + std::sin(angle) * up.cross(front);
  return std::cos(radians(elevation_deg)) * level + std::sin(radians(elevation_deg)) * up;
}

SeenSides sidesOf(const ViewCoverage& coverage, const SideAxes& axes) {
  SeenSides seen;
  for (std::size_t side = 0; side < SeenSides::kSides; ++side) {
    const auto covered = [&](float elevation_deg) {
      return coverage.covers(axes.directionOf(side, elevation_deg));
    };
    seen.sides[side] = std::ranges::any_of(kHeightsOfSides_deg, covered);
    seen.above = seen.above || std::ranges::any_of(kHeightsAbove_deg, covered);
  }
  return seen;
}

std::optional<Eigen::Vector3f> nextDirection(const SeenSides& seen, const SideAxes& axes,
                                             const Eigen::Vector3f& from) {
  // The usual elevations of a hand-held camera around a table.
  constexpr float kLowest_deg = 10, kHighest_deg = 50;
  const float height = from.normalized().dot(axes.up);
  const float elevation_deg =
      std::clamp(std::asin(std::clamp(height, -1.0F, 1.0F)) * 180 / kPi, kLowest_deg, kHighest_deg);
  std::optional<Eigen::Vector3f> next;
  for (std::size_t side = 0; side < SeenSides::kSides; ++side) {
    if (seen.sides[side]) continue;
    const Eigen::Vector3f direction = axes.directionOf(side, elevation_deg);
    if (!next || direction.dot(from) > next->dot(from)) next = direction;
  }
  return next;
}

}  // namespace scantrove
