#include "core/synthetic/thing.h"

#include <utility>

#include "core/base/check.h"
#include "core/synthetic/placed_part.h"

namespace scantrove::synthetic {

double reachOf(const std::vector<SyntheticScene::Part>& parts, const Vec3& direction) {
  double reach = -kNoHit;
  for (const SyntheticScene::Part& part : parts) {
    const Vec3 local = part.T_world_part.linear().transpose() * direction;
    reach = std::max(reach, part.T_world_part.translation().dot(direction) + part.shape->reach(local));
  }
  return reach;
}

Thing::Thing(SyntheticScene&& built, bool round) : who(built.instances().front()) {
  SCANTROVE_CHECK(built.instances().size() == 1);
  parts = std::move(built).takeParts();
  enclose(round);
}

void Thing::enclose(bool round) {
  const double foot = -reachOf(parts, -Vec3::UnitZ());
  for (SyntheticScene::Part& part : parts) part.T_world_part.pretranslate(Vec3(0, 0, -foot));
  const Eigen::Vector2d high(reachOf(parts, Vec3::UnitX()), reachOf(parts, Vec3::UnitY()));
  const Eigen::Vector2d low(-reachOf(parts, -Vec3::UnitX()), -reachOf(parts, -Vec3::UnitY()));
  Volume volume{{(low + high) / 2, (high - low) / 2, 0, 0}, 0, reachOf(parts, Vec3::UnitZ())};
  if (round) {
    volume.base.round = volume.base.half.maxCoeff();
    volume.base.half.setZero();
  }
  volumes = {volume};
  stands.clear();
}

Thing& Thing::withTop(double rim_m) {
  const Volume& volume = volumes.front();
  Footprint area = volume.base;
  const double inscribed = area.round / std::sqrt(2.0);  // inscribed square of a round top
  area.half = (area.half.array() + inscribed - rim_m).max(0.0);
  area.round = 0;
  stands.push_back({area, volume.z_high});
  return *this;
}

Thing& Thing::withSides(double round_m) {
  side_round_m = round_m;
  return *this;
}

Thing& Thing::layDown() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = turned(-90, Vec3::UnitX());
  T.translation().y() = -height() / 2;
  for (SyntheticScene::Part& part : parts) part.T_world_part = T * part.T_world_part;
  enclose(false);
  return *this;
}

double Thing::height() const {
  double height = 0;
  for (const Volume& volume : volumes) height = std::max(height, volume.z_high);
  return height;
}

}  // namespace scantrove::synthetic
