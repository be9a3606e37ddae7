#include "core/synthetic/random_chairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace scantrove::synthetic {
namespace {

class ChairTest : public testing::TestWithParam<std::tuple<ChairBack, std::uint32_t>> {
 protected:
  static Thing make() {
    HashStream random(std::get<1>(GetParam()));
    return makeRandomChair(random, std::get<0>(GetParam()));
  }
  /// Whether a horizontal ray from the front hits the chair.
  static bool isHit(const Thing& chair, double x, double z) {
    return std::ranges::any_of(chair.parts, [&](const SyntheticScene::Part& part) {
      const Eigen::Isometry3d T_part_thing = part.T_world_part.inverse();
      const Ray ray{T_part_thing * Vec3(x, -2, z), T_part_thing.linear() * Vec3::UnitY()};
      return part.shape->intersect(ray, kNoHit).t < kNoHit;
    });
  }
  /// Share of the back that is closed, in a grid between the posts.
  static double closedShare(const Thing& chair) {
    const double seat = chair.stands.front().z;
    const double half = chair.volumes.front().base.half.x() - 0.045;
    int hits = 0;
    constexpr int kSteps = 60;
    for (int i = 0; i < kSteps; ++i) {
      for (int k = 0; k < kSteps; ++k) {
        const double x = half * (2.0 * i / (kSteps - 1) - 1);
        const double z = seat + 0.01 + (chair.height() - 0.06 - seat) * k / (kSteps - 1);
        hits += isHit(chair, x, z) ? 1 : 0;
      }
    }
    return hits / static_cast<double>(kSteps * kSteps);
  }
};
INSTANTIATE_TEST_SUITE_P(Backs, ChairTest,
                         testing::Combine(testing::Values(ChairBack::upright_slats, ChairBack::ladder,
                                                          ChairBack::panel, ChairBack::raised_panel),
                                          testing::Range(1U, 6U)));

TEST_P(ChairTest, StandsOnFourLegs) {
  const Thing chair = make();
  EXPECT_TRUE(chair.who.is_object);
  const auto legs = std::ranges::count_if(chair.parts, [](const SyntheticScene::Part& part) {
    const double foot = part.T_world_part.translation().z() - part.shape->reach(-Vec3::UnitZ());
    return foot < 1e-9;
  });
  EXPECT_EQ(legs, 4);
  EXPECT_FALSE(isHit(chair, 0, 0.2)) << "there is room between the legs";
  const double seat = chair.stands.front().z;
  EXPECT_GT(seat, 0.42);
  EXPECT_LT(seat, 0.48);
  EXPECT_TRUE(isHit(chair, 0, seat - 0.008));
}

TEST_P(ChairTest, HasABackOfItsKind) {
  const Thing chair = make();
  EXPECT_GT(chair.height(), chair.stands.front().z + 0.3);
  const double closed = closedShare(chair);
  switch (std::get<0>(GetParam())) {
    case ChairBack::upright_slats:
    case ChairBack::ladder:
      EXPECT_GT(closed, 0.2);
      EXPECT_LT(closed, 0.75);
      break;
    case ChairBack::panel:
      EXPECT_GT(closed, 0.99);
      break;
    case ChairBack::raised_panel:
      EXPECT_GT(closed, 0.2);
      EXPECT_LT(closed, 0.95);
      EXPECT_FALSE(isHit(chair, 0, chair.stands.front().z + 0.05)) << "the gap above the seat";
      break;
  }
}

}  // namespace
}  // namespace scantrove::synthetic
