#include "core/synthetic/table_settings.h"

#include "core/synthetic/hard_materials.h"
#include "core/synthetic/placed_part.h"
#include "core/synthetic/random_chairs.h"

namespace scantrove::synthetic {

Stand spreadCloth(HashStream& random, Layout& layout, const Stand& top) {
  if (!random.chance(0.4)) return top;
  const double along = random.uniform(0.6, 1.0);
  const double across = random.uniform(0.5, 1.0);
  const Vec3 size{2 * along * top.area.half.x(), 2 * across * top.area.half.y(),
                  random.uniform(0.001, 0.003)};
  SyntheticScene scene;
  addBox(scene, scene.addInstance("tablecloth", false), {}, size, 0.0005, randomCloth(random));
  Thing cloth = std::move(Thing(std::move(scene)).withTop(0.002));
  if (!layout.put(cloth, top.area.center.x(), top.area.center.y(), top.z, top.area.yaw_deg)) return top;
  return layout.newStands().front();
}

void placeChairsAt(HashStream& random, Layout& layout, const Stand& top, int count) {
  for (int i = 0; i < count; ++i) {
    Thing chair = makeRandomChair(random);
    const int side = random.below(4);
    const bool is_long = side % 2 == 0;  // sides 0, 2: along x
    const double room = (is_long ? top.area.half.x() : top.area.half.y()) - 0.3;
    const double along = room > 0 ? random.uniform(-room, room) : 0.0;
    const double away = (is_long ? top.area.half.y() : top.area.half.x()) +
                        chair.volumes.front().base.half.y() + random.uniform(-0.2, 0.12);
    // The chair's frame: front towards -y, so that the one at the side +y faces the table.
    const double yaw_deg = -90.0 * side;
    const Eigen::Vector2d beside = Footprint{{along, away}}.placedAt(0, 0, yaw_deg).center;
    const Eigen::Vector2d at =
        Footprint{beside}.placedAt(top.area.center.x(), top.area.center.y(), top.area.yaw_deg).center;
    layout.put(chair, at.x(), at.y(), 0, top.area.yaw_deg + yaw_deg + random.uniform(-10, 10));
  }
}

}  // namespace scantrove::synthetic
