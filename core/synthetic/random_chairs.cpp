#include "core/synthetic/random_chairs.h"

#include "core/synthetic/hard_materials.h"
#include "core/synthetic/palette.h"
#include "core/synthetic/placed_part.h"

namespace scantrove::synthetic {
namespace {

constexpr double kPost_m = 0.034;
constexpr double kEdge_m = 0.004;
constexpr double kBoard_m = 0.014;  // thickness of slats and panels

/// Measures of a chair.
struct ChairFrame {
  double width, depth, seat, top;
  /// Between the posts.
  [[nodiscard]] double inside() const { return width - 2 * kPost_m; }
  [[nodiscard]] double backY() const { return depth / 2 - kPost_m / 2; }
};

Material chairMaterial(HashStream& random) {
  const double kind = random.uniform(0, 1);
  if (kind < 0.15) return randomDarkness(random);
  if (kind < 0.3) return randomLacquer(random);
  Material wood = randomWood(random);
  if (random.chance(0.6)) wood.pattern = Pattern::grain;
  wood.scale = static_cast<float>(random.uniform(0.006, 0.02));
  wood.gloss = static_cast<float>(random.uniform(0, 0.4));
  return wood;
}

void addSlats(HashStream& random, SyntheticScene& scene, std::uint16_t id, const ChairFrame& frame,
              bool is_upright, const Material& material) {
  const double low = frame.seat;
  const double rise = frame.top - kPost_m - low;
  const int slats = is_upright ? random.between(3, 6) : random.between(2, 4);
  const double covered = random.uniform(0.3, 0.6);  // share that is no gap
  const double pitch = (is_upright ? frame.inside() : rise) / slats;
  for (int i = 0; i < slats; ++i) {
    const double middle = (i + 0.5) * pitch;
    if (is_upright) {
      addBox(scene, id, {}, {covered * pitch, kBoard_m, rise + 0.004}, kEdge_m, material,
             {middle - frame.inside() / 2, frame.backY(), low - 0.002});
    } else {
      addBox(scene, id, {}, {frame.inside() + 0.004, kBoard_m, covered * pitch}, kEdge_m, material,
             {0, frame.backY(), low + middle - covered * pitch / 2});
    }
  }
}

void addPanel(SyntheticScene& scene, std::uint16_t id, const ChairFrame& frame, double gap_m,
              const Material& material) {
  const double low = frame.seat + gap_m - 0.002;
  addBox(scene, id, {}, {frame.inside() + 0.004, kBoard_m, frame.top - kPost_m + 0.002 - low}, kEdge_m,
         material, {0, frame.backY(), low});
}

}  // namespace

Thing makeRandomChair(HashStream& random, ChairBack back) {
  SyntheticScene scene;
  const auto id = scene.addInstance("chair", true, true);
  const ChairFrame frame{random.uniform(0.38, 0.46), random.uniform(0.38, 0.44), random.uniform(0.43, 0.47),
                         random.uniform(0.8, 1.0)};
  const Material skin = chairMaterial(random);
  const double board = random.uniform(0.018, 0.035);
  const double aside = (frame.width - kPost_m) / 2;
  for (const double side : {-1.0, 1.0}) {
    addBox(scene, id, {}, {kPost_m, kPost_m, frame.seat - board + 0.002}, kEdge_m, skin,
           {side * aside, -frame.backY(), 0});
    addBox(scene, id, {}, {kPost_m, kPost_m, frame.top}, kEdge_m, skin, {side * aside, frame.backY(), 0});
  }
  addBox(scene, id, {}, {frame.width - 0.004, frame.depth - 0.004, board}, kEdge_m, skin,
         {0, 0, frame.seat - board});
  addBox(scene, id, {}, {frame.inside() + 0.004, 0.8 * kPost_m, kPost_m}, kEdge_m, skin,
         {0, frame.backY(), frame.top - kPost_m});
  Material filling = skin;
  if (random.chance(0.3)) filling = randomCloth(random);
  if (back == ChairBack::upright_slats || back == ChairBack::ladder) {
    addSlats(random, scene, id, frame, back == ChairBack::upright_slats, skin);
  } else {
    addPanel(scene, id, frame, back == ChairBack::panel ? 0 : random.uniform(0.08, 0.2), filling);
  }
  Thing chair(std::move(scene));
  Footprint all = chair.volumes.front().base;
  Footprint rear = all;
  rear.half.y() = kPost_m / 2;
  rear.center.y() = frame.backY();
  chair.volumes = {{all, 0, frame.seat}, {rear, frame.seat, frame.top}};
  chair.stands = {{{{0, -kPost_m / 2}, {frame.width / 2 - 0.05, frame.depth / 2 - 0.06}}, frame.seat}};
  return chair;
}

Thing makeRandomChair(HashStream& random) {
  const auto back =
      random.pick({ChairBack::upright_slats, ChairBack::ladder, ChairBack::panel, ChairBack::raised_panel});
  return makeRandomChair(random, back);
}

}  // namespace scantrove::synthetic
