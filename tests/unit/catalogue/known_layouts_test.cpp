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

/// Five objects of an earlier scan, and today's world frame, rotated and shifted against the earlier one.
class KnownLayoutsTest : public testing::Test {
 protected:
  KnownLayoutsTest() {
    for (std::size_t i = 0; i < earlier_.size(); ++i) layouts_.add(kYesterday, objectId(i), earlier_[i]);
  }
  static ObjectId objectId(std::size_t i) { return ObjectId{static_cast<std::uint32_t>(i + 1)}; }
  [[nodiscard]] Eigen::Vector3f now(std::size_t i) const { return T_now_earlier_ * earlier_[i]; }
  [[nodiscard]] std::vector<KnownLayouts::ObjectPosition> recognized(
      const std::vector<std::size_t>& objects) const {
    std::vector<KnownLayouts::ObjectPosition> positions;
    for (const std::size_t i : objects) positions.push_back({objectId(i), now(i)});
    return positions;
  }
  void align(const std::vector<KnownLayouts::ObjectPosition>& positions) {
    layouts_.align(positions, [](ObjectId object) { return object; });
  }

  const std::vector<Eigen::Vector3f> earlier_{
      {0, 0, 2}, {1, 0.1F, 2.5F}, {-0.8F, 0.5F, 1.5F}, {0.4F, -0.6F, 3}, {2, 1, 1}};
  const Eigen::Isometry3f T_now_earlier_ =
      Eigen::Translation3f(0.5F, -1, 0.3F) * Eigen::AngleAxisf(0.7F, Eigen::Vector3f(1, 2, -1).normalized());
  KnownLayouts layouts_;
};

TEST_F(KnownLayoutsTest, ExpectsTheOthers_WhenThreeObjectsMatch) {
  EXPECT_THAT(layouts_.expectedAt(now(3)), IsEmpty()) << "no object is recognised";
  align(recognized({0, 1}));
  EXPECT_THAT(layouts_.expectedAt(now(3)), IsEmpty()) << "two are too few";
  align(recognized({0, 1, 2}));
  EXPECT_THAT(layouts_.expectedAt(now(3)), ElementsAre(objectId(3)));
  EXPECT_THAT(layouts_.expectedAt(now(4)), ElementsAre(objectId(4)));
  EXPECT_THAT(layouts_.expectedAt(now(0)), ElementsAre(objectId(0)));
  EXPECT_THAT(layouts_.expectedAt(now(3) + Eigen::Vector3f(0, 0.14F, 0)), ElementsAre(objectId(3)));
  EXPECT_THAT(layouts_.expectedAt(now(3) + Eigen::Vector3f(0, 0.16F, 0)), IsEmpty());
  align({});
  EXPECT_THAT(layouts_.expectedAt(now(3)), IsEmpty()) << "no object is recognised any more";
}

TEST_F(KnownLayoutsTest, ExpectsTheOthers_WhenPositionsAreNoisy) {
  std::vector<KnownLayouts::ObjectPosition> positions = recognized({0, 1, 2, 4});
  for (std::size_t i = 0; i < positions.size(); ++i)
    positions[i].centroid_world[static_cast<int>(i % 3)] += i % 2 == 0 ? 0.03F : -0.03F;
  align(positions);
  EXPECT_THAT(layouts_.expectedAt(now(3)), ElementsAre(objectId(3)));
}

TEST_F(KnownLayoutsTest, ExpectsTheOthers_WhenOneObjectMoved) {
  std::vector<KnownLayouts::ObjectPosition> positions = recognized({0, 1, 2, 4});
  positions[3].centroid_world += Eigen::Vector3f(0.5F, 0, 0);
  align(positions);
  EXPECT_THAT(layouts_.expectedAt(now(3)), ElementsAre(objectId(3)));
}

TEST_F(KnownLayoutsTest, ExpectsNothing_WhenDistancesAreScaled) {
  std::vector<KnownLayouts::ObjectPosition> scaled = recognized({0, 1, 2, 3});
  for (KnownLayouts::ObjectPosition& position : scaled) position.centroid_world *= 1.4F;
  align(scaled);
  EXPECT_THAT(layouts_.expectedAt(now(4)), IsEmpty());
  EXPECT_THAT(layouts_.expectedAt(1.4F * now(4)), IsEmpty());
}

TEST_F(KnownLayoutsTest, ExpectsNothing_WhenTheObjectsLieOnALine) {
  KnownLayouts layouts;
  for (std::size_t i = 0; i < 3; ++i)
    layouts.add(kYesterday, objectId(i),
                Eigen::Vector3f(static_cast<float>(i), 0.05F * static_cast<float>(i % 2), 2));
  layouts.add(kYesterday, objectId(3), {1, 1, 2});
  std::vector<KnownLayouts::ObjectPosition> positions;
  for (std::size_t i = 0; i < 3; ++i)
    positions.push_back(
        {objectId(i), Eigen::Vector3f(static_cast<float>(i), 0.05F * static_cast<float>(i % 2), 2)});
  layouts.align(positions, [](ObjectId object) { return object; });
  EXPECT_THAT(layouts.expectedAt({1, 1, 2}), IsEmpty());
}

// Twelve equal objects are confused with each other, so some three may match earlier positions by chance.
TEST_F(KnownLayoutsTest, ExpectsNothing_WhenObjectsMatchByChance) {
  std::mt19937 random(3);  // of any seed
  std::uniform_real_distribution<float> meters(-1.5F, 1.5F);
  const auto anywhere = [&] { return Eigen::Vector3f(meters(random), meters(random) / 3, meters(random)); };
  int matches = 0;
  for (int room = 0; room < 50; ++room) {
    KnownLayouts layouts;
    std::vector<KnownLayouts::ObjectPosition> positions;
    for (std::size_t i = 0; i < 12; ++i) {
      layouts.add(kYesterday, objectId(i), anywhere());
      positions.push_back({objectId(i), anywhere()});
    }
    layouts.align(positions, [](ObjectId object) { return object; });
    for (int i = 0; i < 20; ++i) matches += layouts.expectedAt(anywhere()).empty() ? 0 : 1;
  }
  EXPECT_EQ(matches, 0) << "of 1000";
}

TEST_F(KnownLayoutsTest, ExpectsTheMergeRoot) {
  layouts_.align(recognized({0, 1, 2}), [](ObjectId object) {
    if (object == objectId(3)) return ObjectId{99};
    return object == objectId(4) ? ObjectId{} : object;
  });
  EXPECT_THAT(layouts_.expectedAt(now(3)), ElementsAre(ObjectId{99}));
  EXPECT_THAT(layouts_.expectedAt(now(4)), IsEmpty()) << "it was deleted";
}

TEST_F(KnownLayoutsTest, OmitsAnObject_WhenItMovedDuringTheEarlierScan) {
  layouts_.add(kYesterday, objectId(3), earlier_[3] + Eigen::Vector3f(0.4F, 0, 0));
  align(recognized({0, 1, 2}));
  EXPECT_THAT(layouts_.expectedAt(now(3)), IsEmpty());
  EXPECT_THAT(layouts_.expectedAt(now(4)), ElementsAre(objectId(4)));
}

TEST_F(KnownLayoutsTest, AlignsEachSessionSeparately) {
  const std::int64_t other = kYesterday + 1;
  for (std::size_t i = 0; i < 4; ++i)
    layouts_.add(other, objectId(i), 2 * earlier_[i] + Eigen::Vector3f(5, 0, 0));
  align(recognized({0, 1, 2}));
  EXPECT_THAT(layouts_.expectedAt(now(3)), ElementsAre(objectId(3)));
  EXPECT_THAT(layouts_.expectedAt(now(4)), ElementsAre(objectId(4)));
}

TEST_F(KnownLayoutsTest, ListsTheNearestFirst) {
  layouts_.add(kYesterday, ObjectId{20}, earlier_[3] + Eigen::Vector3f(0, 0.1F, 0));
  align(recognized({0, 1, 2}));
  EXPECT_THAT(layouts_.expectedAt(now(3)), ElementsAre(objectId(3), ObjectId{20}));
  EXPECT_THAT(layouts_.expectedAt(T_now_earlier_ * (earlier_[3] + Eigen::Vector3f(0, 0.1F, 0))),
              ElementsAre(ObjectId{20}, objectId(3)));
}

}  // namespace
}  // namespace scantrove
