#include "core/labeling/region_partition.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace scantrove {
namespace {

using Constraint = BorderEvidence::Constraint;

/// Fragments that start as separate regions, and their borders.
class RegionPartitionTest : public testing::Test {
 protected:
  static constexpr FragmentId kA{1}, kB{2}, kC{3}, kD{4};

  explicit RegionPartitionTest(int fragments = 4) : voxels_(static_cast<std::size_t>(fragments) + 1, 1000) {
    for (int i = 0; i < fragments; ++i) (void)table_.newFragment();
  }

  /// Fills a border with equal observations: one segment across both fragments, or a fold between different
  /// colours.
  void observe(FragmentId a, FragmentId b, bool as_one, float length_m = 0.5F) {
    BorderEvidence& border = graph_.between(a, b);
    border.observations = border.bends = BorderEvidence::kMaxObservations;
    border.bridged = border.shared = as_one ? border.observations : 0;
    border.folded = as_one ? 0.0F : 1.0F;
    border.concavity_rad = as_one ? 0.0F : 1.2F;
    border.color_shift = as_one ? 2.0F : 30.0F;
    border.colors = {*border.color_shift, *border.color_shift};
    border.length_m = length_m;
    ASSERT_EQ(border.logOdds(1000, 1000) > 0, as_one);
  }
  [[nodiscard]] float oddsBetween(FragmentId a, FragmentId b) {
    return graph_.between(a, b).logOdds(voxels_[a.value], voxels_[b.value]);
  }
  void update(const std::vector<FragmentId>& touched) {
    updatePartition(touched, graph_, voxels_, params_, table_, events_);
  }
  [[nodiscard]] bool areOne(FragmentId a, FragmentId b) const {
    return table_.regionOf(a) == table_.regionOf(b);
  }

  EvidenceGraph graph_;
  RegionTable table_;
  RegionEvents events_;
  LabelingParams params_;
  std::vector<int> voxels_;
};

TEST_F(RegionPartitionTest, JoinsAndSplits_WhenEvidenceChanges) {
  observe(kA, kB, true);
  update({kA, kB});
  EXPECT_TRUE(areOne(kA, kB));
  EXPECT_EQ(events_.joined.size(), 1U);
  observe(kA, kB, false);
  update({kA});
  EXPECT_FALSE(areOne(kA, kB));
  EXPECT_EQ(events_.parted.size(), 1U);
}

TEST_F(RegionPartitionTest, KeepsThePartition_WithinTheHysteresis) {
  observe(kA, kB, true);
  params_.hysteresis = 0.5F;
  const float odds = oddsBetween(kA, kB);
  const auto areOneAt = [&](float log_odds) {
    params_.joining_bias = log_odds - odds;
    update({kA, kB});
    return areOne(kA, kB);
  };
  EXPECT_FALSE(areOneAt(0.4F)) << "separate regions stay separate";
  EXPECT_TRUE(areOneAt(0.6F));
  EXPECT_TRUE(areOneAt(-0.4F)) << "one region stays one";
  EXPECT_FALSE(areOneAt(-0.6F));
}

TEST_F(RegionPartitionTest, CountsAllBordersBetweenTwoRegions) {
  // Borders a - b and b - c weakly favour joining; a - c strongly favours separation.
  observe(kA, kB, true);
  observe(kB, kC, true);
  observe(kA, kC, false);
  params_.joining_bias = 1 + params_.hysteresis - oddsBetween(kA, kB);
  ASSERT_LT(oddsBetween(kA, kC) + params_.joining_bias, -2);
  update({kA, kB, kC});
  EXPECT_TRUE(areOne(kA, kB)) << "of equal borders, the one with lower numbers";
  EXPECT_FALSE(areOne(kB, kC));
  EXPECT_FALSE(areOne(kA, kC));
}

TEST_F(RegionPartitionTest, KeepsUntouchedRegions) {
  observe(kA, kB, true);
  observe(kC, kD, true);
  observe(kB, kC, true);
  update({kA, kB});
  EXPECT_TRUE(areOne(kA, kB));
  EXPECT_FALSE(areOne(kC, kD));
  EXPECT_FALSE(areOne(kB, kC));
  EXPECT_EQ(events_.joined.size(), 1U);
  // A touched fragment includes its complete region.
  update({kA, kC, kD});
  EXPECT_TRUE(areOne(kA, kD));
}

TEST_F(RegionPartitionTest, SmallFragmentFollowsItsLongestBorder) {
  voxels_[kB.value] = kSmallFragmentVoxels - 1;
  observe(kA, kB, false, 0.3F);
  observe(kB, kC, true, 0.1F);
  update({kA, kB, kC});
  EXPECT_TRUE(areOne(kA, kB)) << "a small fragment ignores its evidence";
  EXPECT_FALSE(areOne(kA, kC));
  voxels_[kB.value] = kSmallFragmentVoxels;
  update({kA, kB, kC});
  EXPECT_FALSE(areOne(kA, kB));
  EXPECT_TRUE(areOne(kB, kC));
}

TEST_F(RegionPartitionTest, KeepsSmallFragmentsSeparate_WhenAllAreSmall) {
  voxels_[kA.value] = voxels_[kB.value] = 3;
  observe(kA, kB, true);
  update({kA, kB});
  EXPECT_FALSE(areOne(kA, kB));
}

TEST_F(RegionPartitionTest, ConstraintsOverrideEvidence) {
  observe(kA, kB, false);
  observe(kC, kD, true);
  graph_.constrain(kA, kB, Constraint::must_link);
  graph_.constrain(kC, kD, Constraint::cannot_link);
  params_.joining_bias = 1;
  update({kA, kB, kC, kD});
  EXPECT_TRUE(areOne(kA, kB));
  EXPECT_FALSE(areOne(kC, kD));
  graph_.constrain(kC, kD, Constraint::none);
  update({kC, kD});
  EXPECT_TRUE(areOne(kC, kD));
}

TEST_F(RegionPartitionTest, ConstraintsHold_ForSmallFragments) {
  // b and d are tiny. b borders most on a, but must be linked to c; d must not be linked to c.
  voxels_[kB.value] = voxels_[kD.value] = 5;
  observe(kA, kB, true, 0.5F);
  observe(kB, kC, true, 0.1F);
  observe(kC, kD, true, 0.5F);
  observe(kA, kD, true, 0.1F);
  observe(kA, kC, true, 0.5F);
  graph_.constrain(kB, kC, Constraint::must_link);
  graph_.constrain(kA, kC, Constraint::cannot_link);
  graph_.constrain(kC, kD, Constraint::cannot_link);
  update({kA, kB, kC, kD});
  EXPECT_TRUE(areOne(kB, kC));
  EXPECT_FALSE(areOne(kA, kC));
  EXPECT_TRUE(areOne(kA, kD));
  // The longest border of d is with a region that contains c, to which it cannot be linked.
  graph_.constrain(kA, kC, Constraint::must_link);
  update({kA, kB, kC, kD});
  EXPECT_TRUE(areOne(kA, kC));
  EXPECT_FALSE(areOne(kC, kD));
}

/// Rounds of contradicting constraints between eight fragments.
class PartitionConstraintsTest : public RegionPartitionTest, public testing::WithParamInterface<unsigned> {
 protected:
  static constexpr std::uint32_t kFragments = 8;
  PartitionConstraintsTest() : RegionPartitionTest(kFragments) {}
};

/// Groups of must-linked fragments, and cannot-linked pairs.
struct Accepted {
  std::vector<std::uint32_t> group;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> separate;  // fragments

  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t into = group[a], from = group[b];
    std::ranges::replace(group, from, into);
  }
  [[nodiscard]] bool areSeparate(std::uint32_t a, std::uint32_t b) const {
    return std::ranges::any_of(separate, [&](const auto& pair) {
      const std::pair groups(group[pair.first], group[pair.second]);
      return groups == std::pair(group[a], group[b]) || groups == std::pair(group[b], group[a]);
    });
  }
};

TEST_P(PartitionConstraintsTest, NewestConstraintsWin_WhenTheyContradict) {
  std::mt19937 random(GetParam());
  std::vector<FragmentId> all;
  for (std::uint32_t i = 1; i <= kFragments; ++i) all.push_back(FragmentId{i});
  struct UserConstraint {
    std::uint32_t a, b;
    bool must_link;
  };
  std::vector<UserConstraint> constraints;
  for (int round = 0; round < 16; ++round) {
    const auto a = static_cast<std::uint32_t>(1 + random() % kFragments);
    const auto b = static_cast<std::uint32_t>(1 + (a + random() % (kFragments - 1)) % kFragments);
    observe(FragmentId{a}, FragmentId{b}, random() % 2 == 0);
    const bool must_link = random() % 2 == 0;
    graph_.constrain(FragmentId{a}, FragmentId{b},
                     must_link ? Constraint::must_link : Constraint::cannot_link);
    std::erase_if(constraints,
                  [&](const UserConstraint& old) { return std::minmax(old.a, old.b) == std::minmax(a, b); });
    constraints.push_back({a, b, must_link});
    update(all);

    // From the newest to the oldest, each constraint holds unless it contradicts newer ones.
    Accepted accepted;
    for (std::uint32_t i = 0; i <= kFragments; ++i) accepted.group.push_back(i);
    for (auto it = constraints.rbegin(); it != constraints.rend(); ++it) {
      const bool are_one = accepted.group[it->a] == accepted.group[it->b];
      if (it->must_link ? accepted.areSeparate(it->a, it->b) : are_one) continue;
      EXPECT_EQ(areOne(FragmentId{it->a}, FragmentId{it->b}), it->must_link)
          << it->a << (it->must_link ? " with " : " without ") << it->b << ", round " << round;
      if (it->must_link) {
        accepted.join(it->a, it->b);
      } else {
        accepted.separate.emplace_back(it->a, it->b);
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, PartitionConstraintsTest, testing::Range(1U, 9U));

}  // namespace
}  // namespace scantrove
