#include "ui/models/region_proposals.h"

#include <gtest/gtest.h>

#include <QSettings>

namespace scantrove {
namespace {

/// An appearance of `length_m` x 8 x 8 cm with all pixels in one color bin.
RegionAppearance appearanceOf(float length_m, std::size_t bin) {
  RegionAppearance appearance;
  appearance.size_m = {length_m, 0.08F, 0.08F};
  ColorHistogram::Shares shares{};
  shares[bin] = 1;
  appearance.colors = ColorHistogram::ofShares(shares);
  return appearance;
}

class RegionProposalsTest : public testing::Test {
 protected:
  void SetUp() override { QSettings().clear(); }

  static RegionProposals::Appearances threeBooksAndAMug() {
    return {{RegionId{1}, appearanceOf(0.2F, 7)},
            {RegionId{2}, appearanceOf(0.25F, 7)},
            {RegionId{3}, appearanceOf(0.21F, 7)},
            {RegionId{4}, appearanceOf(0.2F, 90)}};
  }
  static std::vector<RegionId> regionsOf(const RegionProposals& proposals) {
    std::vector<RegionId> regions;
    for (const Proposal& proposal : proposals.open()) regions.push_back(proposal.region);
    return regions;
  }
};

TEST_F(RegionProposalsTest, ProposesSimilarRegions_MostSimilarFirst) {
  RegionProposals proposals;
  proposals.propose(RegionId{1}, QStringLiteral("book"), {}, threeBooksAndAMug());
  EXPECT_EQ(regionsOf(proposals), (std::vector{RegionId{3}, RegionId{2}}));
  EXPECT_TRUE(reasonOf(*proposals.first()).contains(QStringLiteral("21 × 8 × 8 cm")));
}

TEST_F(RegionProposalsTest, RemovesAcceptedProposals) {
  RegionProposals proposals;
  proposals.propose(RegionId{1}, QStringLiteral("book"), QStringLiteral("media"), threeBooksAndAMug());
  const std::vector<Proposal> first = proposals.acceptFirst();
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].region, RegionId{3});
  EXPECT_EQ(first[0].category, QStringLiteral("media"));
  EXPECT_EQ(proposals.acceptAll().size(), 1U);
  EXPECT_EQ(proposals.first(), nullptr);
}

TEST_F(RegionProposalsTest, DoesNotProposeRejectedRegionsAgain_EvenInTheNextScan) {
  {
    RegionProposals proposals;
    proposals.propose(RegionId{1}, QStringLiteral("book"), {}, threeBooksAndAMug());
    proposals.rejectFirst();
    EXPECT_EQ(regionsOf(proposals), std::vector{RegionId{2}});
    proposals.propose(RegionId{1}, QStringLiteral("book"), {}, threeBooksAndAMug());
    EXPECT_EQ(regionsOf(proposals), std::vector{RegionId{2}});
  }
  RegionProposals later;
  RegionProposals::Appearances appearances{{RegionId{11}, appearanceOf(0.26F, 7)},
                                           {RegionId{12}, appearanceOf(0.21F, 7)},
                                           {RegionId{13}, appearanceOf(0.265F, 7)}};
  later.propose(RegionId{11}, QStringLiteral("book"), {}, appearances);
  EXPECT_EQ(regionsOf(later), std::vector{RegionId{13}}) << "12 is similar to the rejected region";
  later.propose(RegionId{11}, QStringLiteral("box"), {}, appearances);
  EXPECT_EQ(regionsOf(later).size(), 2U) << "the rejection was for another name";
}

TEST_F(RegionProposalsTest, ProposesNothing_WhenTheRegionHasNoAppearance) {
  RegionProposals proposals;
  proposals.propose(RegionId{99}, QStringLiteral("book"), {}, threeBooksAndAMug());
  EXPECT_TRUE(proposals.open().empty());
}

}  // namespace
}  // namespace scantrove
