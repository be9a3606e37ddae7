#include "core/refinement/surface_cells.h"

#include <cmath>
#include <limits>

namespace scantrove {
namespace {

constexpr float kCell_m = 0.05F;
constexpr float kMinPlanar = 0.7F;        ///< part of the points
constexpr float kCosSameWay = 0.94F;      ///< 20 degrees: noise, not another side
constexpr float kCosSamePlane = 0.9962F;  ///< 5 degrees
constexpr float kMaxStep_m = 0.02F;
constexpr float kMaxGap_m = 0.3F;

}  // namespace

void SurfaceCells::add(const Eigen::Vector3f& point_world, const Eigen::Vector3f& normal_world) {
  if (normal_world.isZero(0)) return;
  const Eigen::Vector3i at = (point_world / kCell_m).array().floor().cast<int>();
  Cell& cell = cells_[{at.x(), at.y(), at.z()}];
  cell.points += point_world;
  cell.normals += normal_world;
  ++cell.count;
}

std::optional<PlanarPart> SurfaceCells::planarPart() const {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  int all = 0;
  for (const auto& [at, cell] : cells_) {
    mean += cell.normals;
    all += cell.count;
  }
  if (mean.isZero(0)) return std::nullopt;
  mean.normalize();
  PlanarPart part;
  part.normal_world.setZero();
  int planar = 0;
  for (const auto& [at, cell] : cells_) {
    if (cell.normals.dot(mean) <= kCosSameWay * cell.normals.norm()) continue;
    part.normal_world += cell.normals;
    part.points_world.emplace_back(cell.points / static_cast<float>(cell.count));
    part.box_world.extend(part.points_world.back());
    planar += cell.count;
  }
  if (static_cast<float>(planar) < kMinPlanar * static_cast<float>(all)) return std::nullopt;
  part.normal_world.normalize();
  return part;
}

bool continuesInPlane(const PlanarPart& a, const PlanarPart& b) {
  if (a.normal_world.dot(b.normal_world) < kCosSamePlane) return false;
  if (a.box_world.exteriorDistance(b.box_world) > kMaxGap_m) return false;
  float nearest = std::numeric_limits<float>::max();  // m, squared
  Eigen::Vector3f between = Eigen::Vector3f::Zero();
  for (const Eigen::Vector3f& of_a : a.points_world) {
    for (const Eigen::Vector3f& of_b : b.points_world) {
      const float square = (of_a - of_b).squaredNorm();
      if (square >= nearest) continue;
      nearest = square;
      between = of_a - of_b;
    }
  }
  const Eigen::Vector3f normal = (a.normal_world + b.normal_world).normalized();
  return nearest <= kMaxGap_m * kMaxGap_m && std::abs(normal.dot(between)) <= kMaxStep_m;
}

}  // namespace scantrove
