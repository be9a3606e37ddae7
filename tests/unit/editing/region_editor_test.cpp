#include <gmock/gmock.h>

#include "tests/unit/editing/region_editor_fixture.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST_F(RegionEditorTest, JoinHolds_AgainstEvidenceOfTwoObjects) {
  const RegionId first = regionAt(10), second = regionAt(30);
  const auto outcome = apply({.kind = OperationKind::join, .regions = {first, second}});
  ASSERT_TRUE(outcome);
  EXPECT_THAT(outcome->regions, ElementsAre(first));
  EXPECT_THAT(outcome->events.joined, ElementsAre(std::pair(first, second)));
  EXPECT_EQ(regionAt(30), first);
  addEvidence(fragments_[0], fragments_[1], false);
  partition();
  EXPECT_EQ(regionAt(30), regionAt(10));
}

TEST_F(RegionEditorTest, RestoresTheTables_WhenAllIsUndoneAndRedone) {
  ASSERT_TRUE(apply({.kind = OperationKind::name, .regions = {regionAt(10)}, .name = "mug"}));
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(30)}}));
  ASSERT_TRUE(apply({.kind = OperationKind::cut,
                     .regions = {regionAt(50)},
                     .here_world = {{0.42F, 0.05F, 0.005F}},
                     .there_world = {{0.58F, 0.05F, 0.005F}}}));
  ASSERT_TRUE(apply({.kind = OperationKind::background, .regions = {regionAt(70)}}));
  const std::vector<RegionId> done = table_.regions();
  const auto notes = editor_.notes().all();
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(editor_.undo());
  EXPECT_FALSE(editor_.undo());
  EXPECT_EQ(all(), (std::vector{RegionId{1}, RegionId{2}, RegionId{3}, RegionId{4}}));
  EXPECT_EQ(regionAt(42), regionAt(58)) << "one region again";
  EXPECT_TRUE(editor_.notes().all().empty());
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(editor_.redo());
  EXPECT_FALSE(editor_.redo());
  EXPECT_EQ(table_.regions(), done);
  EXPECT_EQ(editor_.notes().all(), notes);
}

TEST_F(RegionEditorTest, RedoneJoinIncludesFragments_AddedSinceTheUndo) {
  const RegionId first = regionAt(10), second = regionAt(30);
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {first, second}}));
  ASSERT_TRUE(editor_.undo());
  grow(second, 80);
  ASSERT_TRUE(editor_.redo());
  EXPECT_EQ(regionAt(30), first);
  EXPECT_EQ(regionAt(90), first) << "it belonged to the second region";
  EXPECT_TRUE(table_.fragmentsOf(second).empty());
  ASSERT_TRUE(editor_.undo());
  EXPECT_EQ(regionAt(30), second);
  EXPECT_EQ(regionAt(90), second);
  EXPECT_EQ(regionAt(10), first);
}

TEST_F(RegionEditorTest, RedoneJoinHolds_WhenItsFragmentWasFreed) {
  const RegionId first = regionAt(10), second = regionAt(30);
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {first, second}}));
  ASSERT_TRUE(editor_.undo());
  const FragmentId grown = grow(second, 80);
  editor_.forget(fragments_[1]);  // as when no voxel has its label any more
  table_.free(fragments_[1]);
  ASSERT_TRUE(editor_.redo());
  EXPECT_EQ(regionAt(90), first);
  EXPECT_EQ(merger_.constraintBetween(fragments_[0], grown), LinkConstraint::must_link);
}

TEST_F(RegionEditorTest, UndoRevertsOnlyTheUsersJoin_WhenFramesJoinedMore) {
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(30)}}));
  addEvidence(fragments_[1], fragments_[2], true);  // evidence from frames after the join
  params_.joining_bias = 5;
  partition();
  params_.joining_bias = 0;
  ASSERT_EQ(regionAt(50), regionAt(30));
  ASSERT_TRUE(editor_.undo());
  EXPECT_NE(regionAt(10), regionAt(30));
}

TEST_F(RegionEditorTest, EvidenceDoesNotJoinNamedRegions) {
  ASSERT_TRUE(apply({.kind = OperationKind::name, .regions = {regionAt(10)}, .name = "book"}));
  ASSERT_TRUE(apply({.kind = OperationKind::name, .regions = {regionAt(30)}, .name = "book"}));
  ASSERT_TRUE(apply({.kind = OperationKind::background, .regions = {regionAt(50)}}));
  ASSERT_TRUE(apply({.kind = OperationKind::background, .regions = {regionAt(70)}}));
  for (std::size_t i = 0; i + 1 < 4; ++i) addEvidence(fragments_[i], fragments_[i + 1], true);
  params_.joining_bias = 5;
  partition();
  EXPECT_NE(regionAt(10), regionAt(30)) << "two named objects of one kind";
  EXPECT_NE(regionAt(30), regionAt(50)) << "an object and background";
  EXPECT_EQ(regionAt(50), regionAt(70)) << "background joins background";
  // A user may join them.
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(30)}}));
  partition();
  EXPECT_EQ(regionAt(10), regionAt(30));
}

TEST_F(RegionEditorTest, CoarserJoinsTheLikelierNeighbor) {
  const RegionId region = regionAt(10);
  ASSERT_TRUE(apply({.kind = OperationKind::join, .regions = {region, regionAt(30)}}));
  ASSERT_TRUE(editor_.undo());
  addEvidence(fragments_[0], fragments_[1], true);
  addEvidence(fragments_[1], fragments_[2], false);
  const auto coarser = apply({.kind = OperationKind::coarser, .regions = {regionAt(30)}});
  ASSERT_TRUE(coarser) << coarser.error().message();
  EXPECT_EQ(regionAt(10), regionAt(30)) << "with the likelier neighbour";
  EXPECT_NE(regionAt(50), regionAt(30));
}

TEST_F(RegionEditorTest, StoresNamesAsTheCatalogueDoes_WhenTheyHaveBlanks) {
  const RegionId region = regionAt(10);
  Operation naming{OperationKind::name, {region}, " mug ", " cup"};
  const auto outcome = apply(naming);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->operation.name, "mug") << "catalogue and session file store this name";
  EXPECT_EQ(editor_.notes().of(region).name, "mug");
  EXPECT_EQ(editor_.notes().of(region).category, "cup");
}

TEST_F(RegionEditorTest, NamingEndsBackground_UntilItIsUndone) {
  const RegionId region = regionAt(10);
  ASSERT_TRUE(apply({OperationKind::background, {region}}));
  ASSERT_TRUE(apply({OperationKind::name, {region}, "mug"}));
  EXPECT_FALSE(editor_.notes().of(region).background) << "data sets omit background";
  ASSERT_TRUE(editor_.undo());
  EXPECT_TRUE(editor_.notes().of(region).background);
}

TEST_F(RegionEditorTest, RefusesNames_WhenTheCatalogueWould) {
  const RegionId region = regionAt(10);
  for (const std::string& name :
       {std::string("two\nlines"), std::string(300, 'x'), std::string("\xFF"), std::string("12")})
    EXPECT_FALSE(apply({OperationKind::name, {region}, name}));
  EXPECT_FALSE(apply({OperationKind::name, {region}, "mug", "two\nlines"}));
  EXPECT_EQ(editor_.notes().of(region), RegionNote{});
  EXPECT_TRUE(editor_.log().entries().empty());
}

TEST_F(RegionEditorTest, RefusesOperations_WhenARegionIsUnknownOrAlone) {
  const auto refused = apply({.kind = OperationKind::name, .regions = {RegionId{77}}, .name = "x"});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("77"));
  EXPECT_FALSE(apply({.kind = OperationKind::join, .regions = {regionAt(10), regionAt(10)}}));
  EXPECT_FALSE(apply({.kind = OperationKind::coarser, .regions = {regionAt(10)}}));
}

TEST(OperationLog, KeepsUndoneOperations_WhenAnotherIsAdded) {
  OperationLog log;
  log.add({.kind = OperationKind::reject, .regions = {RegionId{1}}}, {});
  log.add({.kind = OperationKind::object, .regions = {RegionId{2}}}, {});
  EXPECT_EQ(log.undo()->number, 2);
  EXPECT_EQ(log.undo()->number, 1);
  EXPECT_EQ(log.undo(), nullptr);
  EXPECT_EQ(log.redo()->number, 1);
  log.add({.kind = OperationKind::object, .regions = {RegionId{3}}}, {});
  EXPECT_EQ(log.redo(), nullptr);
  ASSERT_EQ(log.entries().size(), 3U);
  EXPECT_EQ(log.entries()[1].state, OperationLog::State::superseded);
  EXPECT_EQ(log.entries()[2].number, 3);
  EXPECT_THAT(log.takeChanged(), ElementsAre(0, 1, 2));
  EXPECT_TRUE(log.takeChanged().empty());
}

}  // namespace
}  // namespace scantrove::test
