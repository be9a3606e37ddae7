#include <gmock/gmock.h>

#include "tests/unit/editing/region_editor_fixture.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;

TEST_F(RegionEditorTest, UndoneCutReturnsFragments_AddedToItsPart) {
  const RegionId region = regionAt(50);
  const auto outcome = apply({.kind = OperationKind::cut,
                              .regions = {region},
                              .here_world = {{0.42F, 0.05F, 0.005F}},
                              .there_world = {{0.58F, 0.05F, 0.005F}}});
  ASSERT_TRUE(outcome) << outcome.error().message();
  const RegionId part = outcome->regions[0] == region ? outcome->regions[1] : outcome->regions[0];
  grow(part, 80);
  ASSERT_TRUE(editor_.undo());
  EXPECT_EQ(regionAt(42), region);
  EXPECT_EQ(regionAt(58), region);
  EXPECT_EQ(regionAt(90), region) << "the part no longer exists";
  ASSERT_TRUE(editor_.redo());
  EXPECT_EQ(regionAt(90), part);
  EXPECT_NE(regionAt(42), regionAt(58));
}

TEST_F(RegionEditorTest, CutDividesAFragmentAndHolds_AgainstEvidenceOfOneObject) {
  const RegionId region = regionAt(50);
  const auto outcome = apply({.kind = OperationKind::cut,
                              .regions = {region},
                              .here_world = {{0.42F, 0.05F, 0.005F}},
                              .there_world = {{0.58F, 0.05F, 0.005F}}});
  ASSERT_TRUE(outcome) << outcome.error().message();
  ASSERT_EQ(outcome->regions.size(), 2U);
  EXPECT_EQ(regionAt(41), outcome->regions[0]);
  EXPECT_EQ(regionAt(58), outcome->regions[1]);
  EXPECT_NE(outcome->regions[0], outcome->regions[1]);
  EXPECT_TRUE(outcome->regions[0] == region || outcome->regions[1] == region);
  fragments_.push_back(map_.at(41) == fragments_[2] ? map_.at(58) : map_.at(41));
  addEvidence(fragments_[2], fragments_.back(), true);
  partition();
  EXPECT_NE(regionAt(41), regionAt(58));
  // After the undo, evidence decides again.
  ASSERT_TRUE(editor_.undo());
  EXPECT_EQ(regionAt(41), regionAt(58));
  partition();
  EXPECT_EQ(regionAt(41), regionAt(58));
}

// Voxels under a stroke stay on its side, however near the other stroke is.
TEST_F(RegionEditorTest, CutByStrokesKeepsEachStrokeOnItsSide) {
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(30)}}));
  const RegionId region = regionAt(10);
  Operation cut{.kind = OperationKind::cut, .regions = {region}};
  // Two single clicks would divide the 40 voxels in the middle.
  for (int x = 0; x <= 30; ++x)
    cut.here_world.push_back({0.01F * static_cast<float>(x) + 0.005F, 0.055F, 0.005F});
  for (int x = 34; x <= 39; ++x)
    cut.there_world.push_back({0.01F * static_cast<float>(x) + 0.005F, 0.055F, 0.005F});
  const auto outcome = apply(cut);
  ASSERT_TRUE(outcome) << outcome.error().message();
  ASSERT_EQ(outcome->regions.size(), 2U);
  for (int x = 0; x <= 30; ++x) EXPECT_EQ(regionAt(x), outcome->regions[0]) << x;
  for (int x = 35; x <= 39; ++x) EXPECT_EQ(regionAt(x), outcome->regions[1]) << x;
  ASSERT_TRUE(editor_.undo());
  for (int x = 0; x < 40; ++x) EXPECT_EQ(regionAt(x), region) << x;
}

TEST_F(RegionEditorTest, CutByOneStrokeTakesWhatHasItsColor) {
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(30)}}));
  const RegionId region = regionAt(10);
  map_.color(26, 40);
  const auto outcome =
      apply({.kind = OperationKind::cut, .regions = {region}, .here_world = {{0.33F, 0.05F, 0.005F}}});
  ASSERT_TRUE(outcome) << outcome.error().message();
  ASSERT_EQ(outcome->regions.size(), 2U);
  for (int x = 0; x < 40; ++x) {
    if (std::abs(x - 26) <= 1) continue;
    EXPECT_EQ(regionAt(x), outcome->regions[x < 26 ? 1 : 0]) << x;
  }
  EXPECT_EQ(outcome->regions[1], region) << "the larger part keeps its identity";
  ASSERT_TRUE(editor_.undo());
  for (int x = 0; x < 40; ++x) EXPECT_EQ(regionAt(x), region) << x;
  ASSERT_TRUE(editor_.redo());
  EXPECT_NE(regionAt(10), regionAt(35));
}

TEST_F(RegionEditorTest, RefusesACutByOneStroke_WhenNothingDiffersInColor) {
  const auto before = table_.regions();
  for (const bool has_colors : {false, true}) {
    if (has_colors) map_.color(0, 80);
    const auto refused =
        apply({.kind = OperationKind::cut, .regions = {regionAt(50)}, .here_world = {{0.5F, 0.05F, 0.005F}}});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message(), HasSubstr("second stroke"));
  }
  EXPECT_EQ(table_.regions(), before);
  EXPECT_TRUE(editor_.log().entries().empty());
}

TEST_F(RegionEditorTest, FinerFollowsColors_WhenThereIsNoFold) {
  const RegionId region = regionAt(50);
  EXPECT_FALSE(apply({.kind = OperationKind::finer, .regions = {region}})) << "flat, without colours";
  map_.color(50, 60);
  const auto outcome = apply({.kind = OperationKind::finer, .regions = {region}});
  ASSERT_TRUE(outcome) << outcome.error().message();
  EXPECT_EQ(outcome->regions.size(), 2U);
  EXPECT_EQ(regionAt(41), regionAt(48));
  EXPECT_EQ(regionAt(52), regionAt(59));
  EXPECT_NE(regionAt(41), regionAt(59));
}

TEST_F(RegionEditorTest, RefusesACut_WhenBothPointsAreEqual) {
  const auto before = table_.regions();
  const auto refused = apply({.kind = OperationKind::cut,
                              .regions = {regionAt(50)},
                              .here_world = {{0.5F, 0.05F, 0.005F}},
                              .there_world = {{0.5F, 0.05F, 0.005F}}});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("one place"));
  EXPECT_EQ(table_.regions(), before);
  EXPECT_TRUE(editor_.log().entries().empty());
}

TEST_F(RegionEditorTest, CutPartReturnsToItsOriginalRegion_WhenTheJoinIsUndone) {
  const RegionId second = regionAt(30);
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), second}}));
  ASSERT_TRUE(apply({.kind = OperationKind::cut,
                     .regions = {regionAt(30)},
                     .here_world = {{0.22F, 0.05F, 0.005F}},
                     .there_world = {{0.38F, 0.05F, 0.005F}}}));
  ASSERT_NE(map_.at(21), map_.at(38));
  const std::vector<RegionId> done = table_.regions();
  ASSERT_TRUE(editor_.undo());
  ASSERT_TRUE(editor_.undo());
  EXPECT_EQ(regionAt(21), second);
  EXPECT_EQ(regionAt(38), second);
  ASSERT_TRUE(editor_.redo());
  ASSERT_TRUE(editor_.redo());
  EXPECT_EQ(table_.regions(), done);
}

TEST_F(RegionEditorTest, SplitFragmentReturnsToItsOriginalRegion_WhenTheJoinIsUndone) {
  const RegionId first = regionAt(10), second = regionAt(30);
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {first, second}}));
  const auto splitOff = [&](FragmentId fragment, int from, int to) {
    const FragmentId part = table_.newFragmentBeside(fragment);
    map_.setRange(part, from, to);
    editor_.splitOff(part, fragment);
    return part;
  };
  const FragmentId of_first = splitOff(fragments_[0], 0, 5), of_second = splitOff(fragments_[1], 33, 40);
  const FragmentId of_part = splitOff(of_second, 38, 40);
  ASSERT_TRUE(editor_.undo());
  EXPECT_EQ(table_.regionOf(of_first), first);
  EXPECT_EQ(table_.regionOf(of_second), second) << "as without the join";
  EXPECT_EQ(table_.regionOf(of_part), second);
  ASSERT_TRUE(editor_.redo());
  EXPECT_EQ(table_.regionOf(of_second), first);
  EXPECT_EQ(table_.regionOf(of_part), first);
}

}  // namespace
}  // namespace scantrove::test
