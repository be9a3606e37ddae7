#include "core/catalogue/known_layouts.h"

#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::int64_t kYesterday = 7;

/// Where an earlier scan saw five things, and the world of today, which is turned and shifted against it.
class KnownLayoutsTest : public testing::Test {
 protected:
  KnownLayoutsTest() {
    for (std::size_t i = 0; i < then_.size(); ++i) places_.add(kYesterday, thing(i), then_[i]);
  }
  static ObjectId thing(std::size_t i) { return ObjectId{static_cast<std::uint32_t>(i + 1)}; }
  [[nodiscard]] Eigen::Vector3f now(std::size_t i) const { return T_now_then_ * then_[i]; }
  [[nodiscard]] std::vector<KnownLayouts::ObjectPosition> recognized(
      const std::vector<std::size_t>& things) const {
    std::vector<KnownLayouts::ObjectPosition> position;
    for (const std::size_t i : things) position.push_back({thing(i), now(i)});
    return position;
  }
  void align(const std::vector<KnownLayouts::ObjectPosition>& position) {
    places_.align(position, [](ObjectId object) { return object; });
  }

  const std::vector<Eigen::Vector3f> then_{
      {0, 0, 2}, {1, 0.1F, 2.5F}, {-0.8F, 0.5F, 1.5F}, {0.4F, -0.6F, 3}, {2, 1, 1}};
  const Eigen::Isometry3f T_now_then_ =
      Eigen::Translation3f(0.5F, -1, 0.3F) * Eigen::AngleAxisf(0.7F, Eigen::Vector3f(1, 2, -1).normalized());
  KnownLayouts places_;
};

TEST_F(KnownLayoutsTest, ThreeThatStandAsTheyDidTellWhereTheOthersAre) {
  EXPECT_THAT(places_.expectedAt(now(3)), IsEmpty()) << "nothing is recognised";
  align(recognized({0, 1}));
  EXPECT_THAT(places_.expectedAt(now(3)), IsEmpty()) << "two are too few";
  align(recognized({0, 1, 2}));
  EXPECT_THAT(places_.expectedAt(now(3)), ElementsAre(thing(3)));
  EXPECT_THAT(places_.expectedAt(now(4)), ElementsAre(thing(4)));
  EXPECT_THAT(places_.expectedAt(now(0)), ElementsAre(thing(0)));
  EXPECT_THAT(places_.expectedAt(now(3) + Eigen::Vector3f(0, 0.14F, 0)), ElementsAre(thing(3)));
  EXPECT_THAT(places_.expectedAt(now(3) + Eigen::Vector3f(0, 0.16F, 0)), IsEmpty());
  align({});
  EXPECT_THAT(places_.expectedAt(now(3)), IsEmpty()) << "it is another place after all";
}

TEST_F(KnownLayoutsTest, SightingsNeedNotBeExact) {
  std::vector<KnownLayouts::ObjectPosition> position = recognized({0, 1, 2, 4});
  for (std::size_t i = 0; i < position.size(); ++i)
    position[i].centroid_world[static_cast<int>(i % 3)] += i % 2 == 0 ? 0.03F : -0.03F;
  align(position);
  EXPECT_THAT(places_.expectedAt(now(3)), ElementsAre(thing(3)));
}

TEST_F(KnownLayoutsTest, WhatWasPutElsewhereIsOutvoted) {
  std::vector<KnownLayouts::ObjectPosition> position = recognized({0, 1, 2, 4});
  position[3].centroid_world += Eigen::Vector3f(0.5F, 0, 0);
  align(position);
  EXPECT_THAT(places_.expectedAt(now(3)), ElementsAre(thing(3)));
}

TEST_F(KnownLayoutsTest, WhereThingsStandFartherApartIsAnotherPlace) {
  std::vector<KnownLayouts::ObjectPosition> scaled = recognized({0, 1, 2, 3});
  for (KnownLayouts::ObjectPosition& position : scaled) position.centroid_world *= 1.4F;
  align(scaled);
  EXPECT_THAT(places_.expectedAt(now(4)), IsEmpty());
  EXPECT_THAT(places_.expectedAt(1.4F * now(4)), IsEmpty());
}

TEST_F(KnownLayoutsTest, ThreeOnALineTellNothing) {
  KnownLayouts places;
  for (std::size_t i = 0; i < 3; ++i)
    places.add(kYesterday, thing(i),
               Eigen::Vector3f(static_cast<float>(i), 0.05F * static_cast<float>(i % 2), 2));
  places.add(kYesterday, thing(3), {1, 1, 2});
  std::vector<KnownLayouts::ObjectPosition> position;
  for (std::size_t i = 0; i < 3; ++i)
    position.push_back(
        {thing(i), Eigen::Vector3f(static_cast<float>(i), 0.05F * static_cast<float>(i % 2), 2)});
  places.align(position, [](ObjectId object) { return object; });
  EXPECT_THAT(places.expectedAt({1, 1, 2}), IsEmpty());
}

/// Twelve alike things recognised one for another, as in a room of the same mugs: three of them stand
/// somewhere as any three did, by chance.
TEST_F(KnownLayoutsTest, ChanceIsNotBelieved) {
  std::mt19937 random(3);  // of any seed
  std::uniform_real_distribution<float> meters(-1.5F, 1.5F);
  const auto anywhere = [&] { return Eigen::Vector3f(meters(random), meters(random) / 3, meters(random)); };
  int believed = 0;
  for (int room = 0; room < 50; ++room) {
    KnownLayouts places;
    std::vector<KnownLayouts::ObjectPosition> position;
    std::vector<Eigen::Vector3f> then;
    for (std::size_t i = 0; i < 12; ++i) {
      then.push_back(anywhere());
      places.add(kYesterday, thing(i), then.back());
      position.push_back({thing(i), anywhere()});
    }
    places.align(position, [](ObjectId object) { return object; });
    for (int i = 0; i < 20; ++i) believed += places.expectedAt(anywhere()).empty() ? 0 : 1;
  }
  EXPECT_EQ(believed, 0) << "of 1000";
}

TEST_F(KnownLayoutsTest, WhoHoldsAnObjectIsExpected) {
  places_.align(recognized({0, 1, 2}), [](ObjectId object) {
    if (object == thing(3)) return ObjectId{99};
    return object == thing(4) ? ObjectId{} : object;
  });
  EXPECT_THAT(places_.expectedAt(now(3)), ElementsAre(ObjectId{99}));
  EXPECT_THAT(places_.expectedAt(now(4)), IsEmpty()) << "it was deleted";
}

TEST_F(KnownLayoutsTest, WhatMovedWhileItWasSeenHasNoPlace) {
  places_.add(kYesterday, thing(3), then_[3] + Eigen::Vector3f(0.4F, 0, 0));
  align(recognized({0, 1, 2}));
  EXPECT_THAT(places_.expectedAt(now(3)), IsEmpty());
  EXPECT_THAT(places_.expectedAt(now(4)), ElementsAre(thing(4)));
}

TEST_F(KnownLayoutsTest, EachSessionHasAWorldOfItsOwn) {
  const std::int64_t other = kYesterday + 1;
  for (std::size_t i = 0; i < 4; ++i) places_.add(other, thing(i), 2 * then_[i] + Eigen::Vector3f(5, 0, 0));
  align(recognized({0, 1, 2}));
  EXPECT_THAT(places_.expectedAt(now(3)), ElementsAre(thing(3)));
  EXPECT_THAT(places_.expectedAt(now(4)), ElementsAre(thing(4)));
}

TEST_F(KnownLayoutsTest, TheNearestComesFirst) {
  places_.add(kYesterday, ObjectId{20}, then_[3] + Eigen::Vector3f(0, 0.1F, 0));
  align(recognized({0, 1, 2}));
  EXPECT_THAT(places_.expectedAt(now(3)), ElementsAre(thing(3), ObjectId{20}));
  EXPECT_THAT(places_.expectedAt(T_now_then_ * (then_[3] + Eigen::Vector3f(0, 0.1F, 0))),
              ElementsAre(ObjectId{20}, thing(3)));
}

}  // namespace
}  // namespace scantrove
