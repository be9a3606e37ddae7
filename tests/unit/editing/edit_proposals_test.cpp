#include "core/editing/edit_proposals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/labeling/painted_masks.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A wall of three regions side by side.
class EditProposalsTest : public testing::Test {
 protected:
  static constexpr RegionId kA{5}, kB{2}, kC{7};
  static constexpr Rectangle kOnA{0, 0, 20, 47}, kOnB{21, 0, 41, 47}, kOnC{42, 0, 63, 47};
  static constexpr Rectangle kOnAB{0, 0, 41, 47}, kOnBC{21, 0, 63, 47};

  /// Adds frames with these masks.
  void show(int frames, const std::vector<PixelMask>& masks) {
    for (int i = 0; i < frames; ++i) {
      evidence_.add(view_, masks);
      partings_.find(view_, masks);
    }
    for (int i = 0; i < frames; ++i) partings_.count(view_, masks);
  }
  [[nodiscard]] std::vector<EditProposal> proposals(const ProposalParams& params = {}) const {
    return proposeEdits(evidence_, partings_, statements_, params);
  }
  /// Makes the three regions one.
  void mergeAll() { view_ = withRegions(PaintedFrame::corner(0), {{PaintedFrame::kAll, kA}}); }

  RenderedView view_ = withRegions(PaintedFrame::corner(0), {{kOnA, kA}, {kOnB, kB}, {kOnC, kC}});
  MaskEvidence evidence_;
  MaskPartings partings_;
  UserStatements statements_;
};

TEST_F(EditProposalsTest, JoinsRegions_WhenThreeFramesHoldThemTogether) {
  show(2, {maskOf(kOnAB), maskOf(kOnC)});
  EXPECT_THAT(proposals(), IsEmpty());
  EXPECT_EQ(proposals({.min_frames = 2}).size(), 1U);
  show(1, {maskOf(kOnAB)});
  const std::vector<EditProposal> all = proposals();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all.front().operation.kind, OperationKind::join);
  EXPECT_THAT(all.front().operation.regions, ElementsAre(kB, kA));
  EXPECT_EQ(all.front().votes, (MaskVotes{3, 0}));
}

TEST_F(EditProposalsTest, JoinsNothing_WhenOverAQuarterOfTheFramesContradict) {
  show(3, {maskOf(kOnAB)});
  show(1, {maskOf(kOnA)});
  EXPECT_EQ(proposals().size(), 1U);
  show(1, {maskOf(kOnA)});
  EXPECT_THAT(proposals(), IsEmpty());
}

TEST_F(EditProposalsTest, JoinsAllRegionsOfAMaskAtOnce) {
  show(4, {maskOf(PaintedFrame::kAll)});
  const std::vector<EditProposal> all = proposals();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(all.front().operation.regions, ElementsAre(kB, kA, kC));
  EXPECT_EQ(all.front().votes, (MaskVotes{4, 0}));
}

TEST_F(EditProposalsTest, VotesOfAJoinAreThoseOfItsWeakestBorder) {
  show(4, {maskOf(PaintedFrame::kAll)});
  show(2, {maskOf(kOnAB)});
  const std::vector<EditProposal> all = proposals({.min_frames = 4});
  ASSERT_EQ(all.size(), 1U);
  EXPECT_THAT(all.front().operation.regions, ElementsAre(kB, kA))
      << "B and C were apart in two frames, together in four";
  EXPECT_EQ(all.front().votes, (MaskVotes{6, 0}));
  show(2, {maskOf(PaintedFrame::kAll)});
  ASSERT_EQ(proposals().size(), 1U);
  EXPECT_EQ(proposals().front().operation.regions.size(), 3U);
  EXPECT_EQ(proposals().front().votes, (MaskVotes{6, 2}));
}

TEST_F(EditProposalsTest, JoinsNothing_WhenMasksOverlapInTurns) {
  show(4, {maskOf(kOnAB)});
  show(4, {maskOf(kOnBC)});
  EXPECT_THAT(proposals(), IsEmpty());
}

TEST_F(EditProposalsTest, LabeledRegionKeepsItsIdentity) {
  statements_.labeled = {kC};
  show(3, {maskOf(PaintedFrame::kAll)});
  ASSERT_EQ(proposals().size(), 1U);
  EXPECT_THAT(proposals().front().operation.regions, ElementsAre(kC, kB, kA));
}

TEST_F(EditProposalsTest, NeverJoinsTwoLabeledRegions) {
  statements_.labeled = {kA, kC};
  show(3, {maskOf(PaintedFrame::kAll)});
  ASSERT_EQ(proposals().size(), 1U);
  EXPECT_EQ(proposals().front().operation.regions.size(), 2U);
  statements_.labeled = {kA, kB, kC};
  EXPECT_THAT(proposals(), IsEmpty());
}

TEST_F(EditProposalsTest, NeverJoinsWhatAPersonSeparated) {
  statements_.separated = {{kB, kA}};
  show(3, {maskOf(PaintedFrame::kAll)});
  ASSERT_EQ(proposals().size(), 1U);
  EXPECT_THAT(proposals().front().operation.regions, ElementsAre(kB, kC));
  statements_.separated = {{kB, kA}, {kB, kC}};
  EXPECT_THAT(proposals(), IsEmpty());
}

TEST_F(EditProposalsTest, CutsARegion_WhenThreeFramesPartIt) {
  mergeAll();
  show(2, {maskOf(kOnA)});
  EXPECT_THAT(proposals(), IsEmpty());
  show(1, {maskOf(kOnA)});
  const std::vector<EditProposal> all = proposals();
  ASSERT_EQ(all.size(), 1U);
  const Operation& cut = all.front().operation;
  EXPECT_EQ(cut.kind, OperationKind::cut);
  EXPECT_THAT(cut.regions, ElementsAre(kA));
  EXPECT_EQ(all.front().votes, (MaskVotes{0, 3}));
  // The mask ends between columns 20 and 21 of 64.
  const float outline_x = (20.5F - 31.5F) / 60;
  for (const Eigen::Vector3f& point : cut.here_world) EXPECT_LT(point.x(), outline_x);
  for (const Eigen::Vector3f& point : cut.there_world) EXPECT_GT(point.x(), outline_x);
}

TEST_F(EditProposalsTest, NeverCutsWhatAPersonLabeledOrJoined) {
  mergeAll();
  show(3, {maskOf(kOnA)});
  ASSERT_EQ(proposals().size(), 1U);
  statements_.labeled = {kA};
  EXPECT_THAT(proposals(), IsEmpty());
  statements_.labeled = {};
  statements_.joined = {kA};
  EXPECT_THAT(proposals(), IsEmpty());
}

TEST_F(EditProposalsTest, DoesNotJoinRegions_WhenTheyAreToBeCut) {
  // B and C are one region of which the mask holds three quarters, and all of A.
  view_ = withRegions(PaintedFrame::corner(0), {{kOnA, kA}, {kOnBC, kB}});
  show(3, {maskOf({0, 0, 53, 47})});
  const std::vector<EditProposal> all = proposals();
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all.front().operation.kind, OperationKind::cut);
  EXPECT_THAT(all.front().operation.regions, ElementsAre(kB));
}

TEST_F(EditProposalsTest, MostAgreementComesFirst) {
  view_ = withRegions(PaintedFrame::corner(0), {{kOnA, kA}, {kOnB, kB}});
  show(3, {maskOf(kOnAB)});
  view_ = withRegions(PaintedFrame::corner(0), {{kOnC, kC}});
  show(4, {maskOf({42, 0, 63, 23})});
  const std::vector<EditProposal> all = proposals();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].operation.kind, OperationKind::cut);
  EXPECT_EQ(all[1].operation.kind, OperationKind::join);
}

TEST(UserStatements, ConstraintsOfAPersonCount_ThoseOfTheProgramDoNot) {
  RegionTable table;
  std::vector<FragmentId> fragments;
  for (int i = 0; i < 6; ++i) fragments.push_back(table.newFragment());
  const auto regionOf = [&](std::size_t i) { return table.regionOf(fragments[i]); };
  EvidenceGraph evidence;
  evidence.constrain(fragments[1], fragments[0], LinkConstraint::cannot_link);
  evidence.constrain(fragments[2], fragments[3], LinkConstraint::must_link);
  evidence.constrain(fragments[0], fragments[2], LinkConstraint::cannot_link, false);
  evidence.constrain(fragments[4], fragments[5], LinkConstraint::must_link, false);
  ASSERT_TRUE(table.join(regionOf(2), regionOf(3)));
  ASSERT_TRUE(table.join(regionOf(4), regionOf(5)));
  UserStatements statements;
  statements.addConstraints(table, evidence);
  EXPECT_THAT(statements.separated, ElementsAre(MaskEvidence::Border(regionOf(0), regionOf(1))));
  EXPECT_THAT(statements.joined, ElementsAre(regionOf(2)));
  EXPECT_THAT(statements.labeled, IsEmpty());
}

}  // namespace
}  // namespace scantrove::test
