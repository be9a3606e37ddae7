#include "core/refinement/finer_regions.h"

#include <gmock/gmock.h>

#include "core/labeling/graph_merger.h"

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using testing::UnorderedElementsAre;

/// Three books in a row and a box. Weak evidence joins the first two books into one region.
class FinerRegionsTest : public testing::Test {
 protected:
  static constexpr FragmentId kFirst{1}, kSecond{2}, kThird{3}, kBox{4};

  FinerRegionsTest() {
    for (int i = 0; i < 4; ++i) static_cast<void>(table_.newFragment());
    BorderEvidence& border = merger_.evidence()->between(kFirst, kSecond);
    border.observations = border.bends = BorderEvidence::kMaxObservations;
    border.bridged = border.shared = border.observations;
    border.length_m = 0.2F;
    table_.join(table_.regionOf(kFirst), table_.regionOf(kSecond));
    setBorderOdds(1);
  }
  /// Sets the log-odds of the border within the region.
  void setBorderOdds(float odds) {
    params_.joining_bias = 0;
    params_.joining_bias = odds - merger_.evidence()->find(kFirst, kSecond)->logOdds(1000, 1000);
  }
  [[nodiscard]] FinerRegions finer() const {
    return {table_, merger_, voxels_, params_, [this](RegionId region) { return region == excluded_; }};
  }
  [[nodiscard]] RegionId of(FragmentId fragment) const { return table_.regionOf(fragment); }

  GraphMerger merger_;
  RegionTable table_;
  LabelingParams params_;
  std::vector<int> voxels_ = std::vector<int>(5, 1000);
  RegionId excluded_;
};

TEST_F(FinerRegionsTest, DividesARegion_WhenItsEvidenceIsWeak) {
  const FinerRegions finer = this->finer();
  ASSERT_TRUE(finer.areDivided());
  const RegionId first = finer.table().regionOf(kFirst), second = finer.table().regionOf(kSecond);
  EXPECT_NE(first, second);
  EXPECT_EQ(of(kFirst), of(kSecond)) << "the original table is unchanged";
  EXPECT_EQ(finer.table().regionOf(kBox), of(kBox));
  EXPECT_EQ(finer.partsOf({of(kFirst), of(kBox)}), (RegionSet{first, second, of(kBox)}));
  EXPECT_TRUE(finer.holdsPart({first, of(kBox)}));
  EXPECT_FALSE(finer.holdsPart({of(kThird), of(kBox)}));
}

TEST_F(FinerRegionsTest, KeepsARegion_WhenItsEvidenceIsStrong) {
  setBorderOdds(6);
  EXPECT_FALSE(finer().areDivided());
}

TEST_F(FinerRegionsTest, KeepsARegion_WhenKnownLabeledOrExcluded) {
  table_.setKnown(of(kFirst), true);
  EXPECT_FALSE(finer().areDivided());
  table_.setKnown(of(kFirst), false);
  excluded_ = of(kFirst);
  EXPECT_FALSE(finer().areDivided());
  excluded_ = {};
  table_.setUserLabel(of(kFirst), UserLabel::background);
  EXPECT_FALSE(finer().areDivided());
}

TEST_F(FinerRegionsTest, PartBecomesARegion_WhenItIsAnObject) {
  const FinerRegions finer = this->finer();
  const RegionSet object{finer.table().regionOf(kSecond)};
  RegionEvents events;
  finer.apply(std::vector{object}, table_, merger_, voxels_, events);
  EXPECT_NE(of(kFirst), of(kSecond));
  EXPECT_THAT(events.parted, SizeIs(1));
  EXPECT_THAT(events.joined, IsEmpty());
  EXPECT_EQ(finer.regionsOf(object, table_), RegionSet{of(kSecond)});
  EXPECT_EQ(merger_.constraintBetween(kFirst, kSecond), LinkConstraint::cannot_link);
  // The evidence alone would join them again.
  EXPECT_EQ(merger_.joiningOdds(of(kFirst), of(kSecond), table_, voxels_, params_), std::nullopt);
}

TEST_F(FinerRegionsTest, PartIsSplitOff_WhenItsObjectIncludesAnotherRegion) {
  const FinerRegions finer = this->finer();
  const RegionSet object{finer.table().regionOf(kSecond), of(kThird)};
  RegionEvents events;
  finer.apply(std::vector{object}, table_, merger_, voxels_, events);
  EXPECT_EQ(finer.regionsOf(object, table_), (RegionSet{of(kSecond), of(kThird)}));
  EXPECT_NE(of(kSecond), of(kFirst));
}

TEST_F(FinerRegionsTest, ChangesNothing_WhenObjectsAreRegions) {
  const FinerRegions finer = this->finer();
  const RegionSet books = finer.partsOf({of(kFirst)});
  const std::uint64_t version = table_.version();
  RegionEvents events;
  finer.apply(std::vector{books, RegionSet{of(kBox)}}, table_, merger_, voxels_, events);
  EXPECT_EQ(table_.version(), version);
  EXPECT_THAT(events.parted, IsEmpty());
  EXPECT_EQ(finer.regionsOf(books, table_), RegionSet{of(kFirst)});
  EXPECT_EQ(finer.regionsOf({finer.table().regionOf(kFirst)}, table_), std::nullopt) << "a part of a region";
  EXPECT_EQ(merger_.constraintBetween(kFirst, kSecond), LinkConstraint::none);
}

}  // namespace
}  // namespace scantrove
