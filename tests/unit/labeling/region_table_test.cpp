#include "core/labeling/region_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace scantrove {
namespace {

using Pairs = std::vector<std::pair<RegionId, RegionId>>;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr FragmentId kA{1}, kB{2}, kC{3}, kD{4};

RegionTable tableWith(int fragments) {
  RegionTable table;
  for (int i = 0; i < fragments; ++i) (void)table.newFragment();
  return table;
}

TEST(RegionTable, NewFragmentGetsANewRegion) {
  RegionTable table;
  EXPECT_EQ(table.regionOf(FragmentId{}), RegionId{});
  const FragmentId a = table.newFragment();
  const FragmentId b = table.newFragment();
  EXPECT_NE(a, b);
  EXPECT_NE(table.regionOf(a), table.regionOf(b));
  EXPECT_THAT(table.fragmentsOf(table.regionOf(b)), ElementsAre(b));
  EXPECT_THAT(table.regions(), ElementsAre(RegionId{}, table.regionOf(a), table.regionOf(b)));
}

TEST(RegionTable, SplitFragmentStaysInItsRegion) {
  RegionTable table;
  const FragmentId a = table.newFragment();
  const FragmentId b = table.newFragment();
  table.free(a);
  const FragmentId cut = table.newFragmentBeside(b);
  EXPECT_EQ(cut, a) << "the lowest free number";
  EXPECT_EQ(table.regionOf(cut), table.regionOf(b));
  EXPECT_THAT(table.fragmentsOf(table.regionOf(b)), testing::ElementsAre(a, b)) << "in ascending order";
}

TEST(RegionTable, JoinMovesAllFragmentsOfBoth) {
  RegionTable table = tableWith(3);
  const RegionId a = table.regionOf(kA), b = table.regionOf(kB), c = table.regionOf(kC);
  EXPECT_TRUE(table.join(c, b));
  EXPECT_TRUE(table.join(a, c));
  EXPECT_THAT(table.fragmentsOf(a), ElementsAre(kA, kB, kC));
  EXPECT_THAT(table.regions(), ElementsAre(RegionId{}, a, a, a));
  EXPECT_THAT(table.fragmentsOf(c), IsEmpty());
}

TEST(RegionTable, JoinFails_WithItselfNoneOrAFormerRegion) {
  RegionTable table = tableWith(2);
  const RegionId a = table.regionOf(kA), b = table.regionOf(kB);
  EXPECT_FALSE(table.join(a, a));
  EXPECT_FALSE(table.join(a, RegionId{}));
  EXPECT_FALSE(table.join(RegionId{}, a));
  ASSERT_TRUE(table.join(a, b));
  const std::uint64_t version = table.version();
  EXPECT_FALSE(table.join(a, b));
  EXPECT_FALSE(table.join(b, a));
  EXPECT_EQ(table.version(), version);
}

TEST(RegionTable, ReusesNumbersOfFragmentsButNotOfRegions) {
  RegionTable table = tableWith(4);
  std::set<RegionId> seen(table.regions().begin(), table.regions().end());
  table.free(kC);
  table.free(kA);
  table.free(kA);  // free already
  EXPECT_EQ(table.regionOf(kA), RegionId{});
  EXPECT_EQ(table.newFragment(), kA) << "the lowest first";
  EXPECT_EQ(table.newFragment(), kC);
  EXPECT_EQ(table.newFragment(), FragmentId{5});
  for (const FragmentId fragment : {kA, kC, FragmentId{5}}) {
    EXPECT_TRUE(seen.insert(table.regionOf(fragment)).second);
  }
}

TEST(RegionTable, RegionEnds_WhenItsLastFragmentIsFreed) {
  RegionTable table = tableWith(2);
  const RegionId region = table.regionOf(kA);
  table.setKnown(region, true);
  ASSERT_TRUE(table.join(region, table.regionOf(kB)));
  table.free(kA);
  EXPECT_THAT(table.fragmentsOf(region), ElementsAre(kB));
  EXPECT_TRUE(table.isKnown(region));
  table.free(kB);
  EXPECT_THAT(table.fragmentsOf(region), IsEmpty());
  EXPECT_FALSE(table.isKnown(region));
}

TEST(RegionTable, LargestPartKeepsTheIdentity_WhenARegionIsDivided) {
  RegionTable table = tableWith(3);
  const RegionId original = table.regionOf(kA);
  ASSERT_TRUE(table.join(original, table.regionOf(kB)));
  ASSERT_TRUE(table.join(original, table.regionOf(kC)));
  RegionEvents events;
  table.divide({{kA}, {kB, kC}}, std::vector<int>{0, 100, 70, 60}, events);
  EXPECT_EQ(table.regionOf(kB), original);
  EXPECT_EQ(table.regionOf(kC), original);
  EXPECT_NE(table.regionOf(kA), original);
  EXPECT_EQ(events.parted, (Pairs{{original, table.regionOf(kA)}}));
  EXPECT_THAT(events.joined, IsEmpty());
}

TEST(RegionTable, LargestRegionKeepsItsIdentity_WhenRegionsJoin) {
  RegionTable table = tableWith(3);
  const RegionId a = table.regionOf(kA), b = table.regionOf(kB), c = table.regionOf(kC);
  RegionEvents events;
  table.divide({{kA, kB, kC}}, std::vector<int>{0, 10, 30, 20}, events);
  EXPECT_THAT(table.fragmentsOf(b), ElementsAre(kA, kB, kC));
  EXPECT_EQ(events.joined, (Pairs{{b, a}, {b, c}}));
  EXPECT_THAT(events.parted, IsEmpty());
}

TEST(RegionTable, KnownRegionKeepsItsIdentity_WhenJoinedWithALargerOne) {
  RegionTable table = tableWith(2);
  const RegionId known = table.regionOf(kA), larger = table.regionOf(kB);
  table.setKnown(known, true);
  RegionEvents events;
  table.divide({{kA, kB}}, std::vector<int>{0, 10, 3000}, events);
  EXPECT_EQ(table.regionOf(kB), known);
  EXPECT_TRUE(table.isKnown(known));
  EXPECT_EQ(events.joined, (Pairs{{known, larger}}));
}

TEST(RegionTable, JoinedRegionIsKnown_WhenEitherWas) {
  RegionTable table = tableWith(2);
  const RegionId into = table.regionOf(kA), from = table.regionOf(kB);
  table.setKnown(from, true);
  ASSERT_TRUE(table.join(into, from));
  EXPECT_TRUE(table.isKnown(into));
  EXPECT_FALSE(table.isKnown(from));
}

TEST(RegionTable, DivideJoinsAndSplitsAtOnce) {
  // {a, b} and {c, d} become {a} and {b, c, d}.
  RegionTable table = tableWith(4);
  const RegionId ab = table.regionOf(kA), cd = table.regionOf(kC);
  ASSERT_TRUE(table.join(ab, table.regionOf(kB)));
  ASSERT_TRUE(table.join(cd, table.regionOf(kD)));
  RegionEvents events;
  table.divide({{kA}, {kB, kC, kD}}, std::vector<int>{0, 50, 60, 10, 10}, events);
  // b is the largest fragment of both the second part and the first region, so the part keeps that region.
  // The second region ends, and a gets a new one.
  EXPECT_EQ(table.regionOf(kB), ab);
  EXPECT_THAT(table.fragmentsOf(ab), ElementsAre(kB, kC, kD));
  EXPECT_THAT(table.fragmentsOf(cd), IsEmpty());
  EXPECT_EQ(events.parted, (Pairs{{ab, table.regionOf(kA)}}));
  EXPECT_EQ(events.joined, (Pairs{{ab, cd}}));
}

TEST(RegionTable, DivideChangesNothing_WhenPartsAreTheRegions) {
  RegionTable table = tableWith(3);
  ASSERT_TRUE(table.join(table.regionOf(kA), table.regionOf(kC)));
  const std::uint64_t version = table.version();
  RegionEvents events;
  table.divide({{kC, kA}, {kB}}, std::vector<int>{0, 5, 5, 5}, events);
  EXPECT_EQ(table.version(), version);
  EXPECT_THAT(events.joined, IsEmpty());
  EXPECT_THAT(events.parted, IsEmpty());
}

TEST(RegionTable, EventsDescribeEveryChange_InRandomDivisions) {
  constexpr std::uint32_t kFragments = 12;
  std::mt19937 random(3);
  RegionTable table = tableWith(kFragments);
  std::set<RegionId> used(table.regions().begin(), table.regions().end());
  for (int round = 0; round < 200; ++round) {
    const std::set<RegionId> before(table.regions().begin() + 1, table.regions().end());
    std::vector<std::vector<FragmentId>> parts(1 + random() % kFragments);
    std::vector<int> voxels{0};
    for (std::uint32_t i = 1; i <= kFragments; ++i) {
      parts[random() % parts.size()].push_back(FragmentId{i});
      voxels.push_back(static_cast<int>(random() % 100));
    }
    std::erase_if(parts, [](const auto& part) { return part.empty(); });
    const RegionId known = *std::next(before.begin(), static_cast<int>(random() % before.size()));
    table.setKnown(known, true);
    RegionEvents events;
    table.divide(parts, voxels, events);

    std::set<RegionId> after;
    for (const auto& part : parts) {
      const RegionId region = table.regionOf(part.front());
      EXPECT_TRUE(after.insert(region).second);
      EXPECT_THAT(table.fragmentsOf(region), testing::ElementsAreArray(part));
    }
    std::set<RegionId> expected = before;
    for (const auto& [into, from] : events.joined) {
      EXPECT_EQ(expected.erase(from), 1U) << "joined twice, or did not exist";
      EXPECT_TRUE(after.contains(into));
    }
    for (const auto& [from, part] : events.parted) {
      EXPECT_TRUE(before.contains(from));
      EXPECT_TRUE(after.contains(from)) << "the divided region continues";
      EXPECT_TRUE(used.insert(part).second) << "a number used before";
      expected.insert(part);
    }
    EXPECT_EQ(after, expected);
    EXPECT_TRUE(after.contains(known));
    table.setKnown(known, false);
  }
}

TEST(RegionTable, ListsFragmentsWithAChangedRegion) {
  RegionTable table;
  const FragmentId a = table.newFragment(), b = table.newFragment(), c = table.newFragment();
  EXPECT_EQ(table.takeChanged(), (std::vector{a, b, c}));
  EXPECT_TRUE(table.takeChanged().empty());
  table.join(table.regionOf(a), table.regionOf(b));
  EXPECT_EQ(table.takeChanged(), std::vector{b}) << "a and c are unchanged";
  table.free(b);
  table.free(c);
  static_cast<void>(table.newFragment());  // reuses one of the numbers
  const std::vector<FragmentId> changed = table.takeChanged();
  EXPECT_EQ(std::set<FragmentId>(changed.begin(), changed.end()), (std::set{b, c})) << "each once";
  EXPECT_EQ(changed.size(), 2U);
}

TEST(RegionTable, MovesFragments_WhenStillInTheirRegion) {
  RegionTable table;
  const FragmentId a = table.newFragment(), b = table.newFragment(), c = table.newFragment();
  const RegionId of_a = table.regionOf(a), of_b = table.regionOf(b), of_c = table.regionOf(c);
  ASSERT_TRUE(table.join(of_a, of_b));
  ASSERT_TRUE(table.join(of_a, of_c));
  RegionEvents events;
  const std::vector<RegionMove> moves{{b, of_a, of_b}, {c, of_b, of_c}};  // c is not in b's region
  table.move(moves, events);
  EXPECT_EQ(table.regionOf(b), of_b);
  EXPECT_EQ(table.regionOf(c), of_a);
  EXPECT_EQ(events.parted, (std::vector{std::pair(of_a, of_b)}));
  EXPECT_TRUE(events.joined.empty());
  events = {};
  table.move(std::vector<RegionMove>{{b, of_b, of_a}}, events);
  EXPECT_EQ(events.joined, (std::vector{std::pair(of_a, of_b)}));
  EXPECT_TRUE(table.fragmentsOf(of_b).empty());
}

TEST(RegionTable, LabeledRegionKeepsItsIdentity_WhenJoinedWithAKnownOne) {
  RegionTable table;
  const FragmentId large = table.newFragment(), small = table.newFragment();
  const RegionId labeled = table.regionOf(small);
  table.setKnown(table.regionOf(large), true);
  table.setUserLabel(labeled, UserLabel::object);
  RegionEvents events;
  const std::vector<int> voxels{0, 1000, 10};
  table.divide({{large, small}}, voxels, events);
  EXPECT_EQ(table.regionOf(large), labeled);
}

TEST(RegionTable, SeparatesFragments_AsANewRegion) {
  RegionTable table;
  const FragmentId a = table.newFragment(), b = table.newFragment(), c = table.newFragment();
  const RegionId region = table.regionOf(a);
  table.join(region, table.regionOf(b));
  table.join(region, table.regionOf(c));
  RegionEvents events;
  const RegionId part = table.separate(std::vector{b, c}, events);
  EXPECT_EQ(part, table.lastRegion()) << "never a former one";
  EXPECT_EQ(table.regionOf(a), region);
  EXPECT_EQ(table.regionOf(b), part);
  EXPECT_EQ(table.regionOf(c), part);
  EXPECT_EQ(events.parted, std::vector{std::pair(region, part)});
  EXPECT_TRUE(events.joined.empty());
}

TEST(RegionTable, RestoresFreeNumbers) {
  RegionTable table;
  for (int i = 0; i < 5; ++i) table.newFragment();
  table.free(FragmentId{2});
  table.free(FragmentId{4});
  RegionTable again;
  again.restore(table.regions(), table.lastRegion());
  EXPECT_EQ(again.regions(), table.regions());
  EXPECT_EQ(again.newFragment(), FragmentId{2}) << "the lowest first, as before";
  EXPECT_EQ(again.regionOf(FragmentId{2}), RegionId{6}) << "never a former one";
  EXPECT_EQ(again.newFragment(), FragmentId{4});
  EXPECT_EQ(again.newFragment(), FragmentId{6});
}

TEST(RegionTable, EachFollowerTakesEveryChange) {
  RegionTable table;
  const FragmentId fragment = table.newFragment();
  EXPECT_EQ(table.takeChanged(RegionTable::Reader::window), std::vector{fragment});
  EXPECT_TRUE(table.takeChanged(RegionTable::Reader::window).empty());
  EXPECT_EQ(table.takeChanged(RegionTable::Reader::session), std::vector{fragment});
}

}  // namespace
}  // namespace scantrove
