#include "core/collection/identity_resolver.h"

#include <gmock/gmock.h>

#include <array>

#include "tests/pipeline/collection/parts_fixture.h"

namespace scantrove {
namespace {

using test::TableItem;

class IdentityResolverTest : public test::PartsFixture {
 protected:
  static constexpr int kBestFrame = 3;  // of any set
  static CompleteSet setOf(const RegionSet& regions) { return {regions, kBestFrame}; }
  void settle(const std::vector<CompleteSet>& sets) { identities_->settle(sets); }
  void mergeAll() { identities_->merge(IdentityResolver::Which::all, frame_); }
};

TEST_F(IdentityResolverTest, SetTakesTheObjectOfOneOfItsRegions) {
  const ObjectId mug = add(mug_);
  const RegionId handle{77};
  settle({setOf({mug_.region, handle})});
  EXPECT_EQ(tracks_->objectOf(handle), mug);
  EXPECT_EQ(tracks_->objectOf(mug_.region), mug);
}

TEST_F(IdentityResolverTest, MostLikelySetTakesTheObject_WhenTwoSetsHoldItsRegions) {
  const ObjectId mug = add(mug_);
  tracks_->bind({box_.region}, mug);
  settle({setOf({mug_.region}), setOf({box_.region})});
  EXPECT_EQ(tracks_->objectOf(mug_.region), mug);
  EXPECT_FALSE(tracks_->objectOf(box_.region));
}

TEST_F(IdentityResolverTest, SetsAreTwoObjects_WhenTheScanMergedTheirObjects) {
  const ObjectId mug = add(mug_), box = add(box_);
  identities_->requestMerge({mug, box}, frame_);
  mergeAll();
  ASSERT_EQ(rootOf(box_.region), mug);
  settle({setOf({mug_.region}), setOf({box_.region})});
  EXPECT_EQ(rootOf(mug_.region), mug);
  EXPECT_FALSE(tracks_->objectOf(box_.region));
}

TEST_F(IdentityResolverTest, SetsAreOneObject_WhenAUserMergedTheirObjects) {
  const ObjectId mug = add(mug_), box = add(box_);
  store();
  ASSERT_TRUE(person_->merge(std::array{idOf(mug), idOf(box)}));  // neither is named or confirmed
  store();
  settle({setOf({mug_.region}), setOf({box_.region})});
  EXPECT_EQ(rootOf(mug_.region), mug);
  EXPECT_EQ(rootOf(box_.region), mug);
}

TEST_F(IdentityResolverTest, SetIsIgnored_WhenAUserNamedTwoOfItsObjects) {
  const ObjectId mug = add(mug_), box = add(box_);
  store();
  ASSERT_TRUE(person_->rename(idOf(mug), "my mug"));
  ASSERT_TRUE(person_->rename(idOf(box), "my box"));
  store();
  settle({setOf({mug_.region, box_.region})});
  EXPECT_TRUE(identities_->complete().empty());
  EXPECT_EQ(tracks_->objectOf(mug_.region), mug);
  EXPECT_EQ(tracks_->objectOf(box_.region), box);
}

TEST_F(IdentityResolverTest, SetIsIgnored_WhenAUserDeletedItsObject) {
  const ObjectId mug = add(mug_);
  store();
  ASSERT_TRUE(person_->remove(std::array{idOf(mug)}));
  store();
  settle({setOf({mug_.region})});
  EXPECT_TRUE(identities_->complete().empty());
}

TEST_F(IdentityResolverTest, ObjectIsReplaced_WhenItHasNoRegionsLeft) {
  const ObjectId part = add(mug_);
  tracks_->unbind({mug_.region}, part);
  const ObjectId larger = add(mug_);
  identities_->replace(part, larger);
  EXPECT_EQ(identities_->replacementOf(part), larger);
  EXPECT_TRUE(identities_->haveOneReplacement(part, larger));
}

TEST_F(IdentityResolverTest, ObjectIsNotReplaced_WhenItIsACompleteSetAfterAll) {
  const ObjectId part = add(mug_);
  tracks_->unbind({mug_.region}, part);
  const ObjectId larger = add(mug_);
  identities_->replace(part, larger);
  const RegionId again{77};
  tracks_->bind({again}, part);
  settle({setOf({again}), setOf({mug_.region})});
  EXPECT_EQ(identities_->replacementOf(part), part);
}

TEST_F(IdentityResolverTest, ReplacedObjectIsMerged_WhenItsViewsAreValid) {
  const ObjectId part = add(mug_);
  tracks_->unbind({mug_.region}, part);
  const ObjectId larger = add(mug_, 60);
  identities_->replace(part, larger);
  identities_->mergeReplaced(views_->objectsInValidViews());
  store();
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].views, 2) << "views of both";
}

TEST_F(IdentityResolverTest, RegionsLeaveTheirObject_AfterSeveralMismatches) {
  const ObjectId mug = add(mug_);
  for (int i = 0; i < 9; ++i) identities_->countMismatch(mug_.candidate(), mug, frame_);
  EXPECT_EQ(tracks_->objectOf(mug_.region), mug);
  identities_->countMismatch(mug_.candidate(), mug, frame_);
  EXPECT_FALSE(tracks_->objectOf(mug_.region));
  constexpr int kLater = 100;
  EXPECT_EQ(identities_->nearby(mug_.candidate(), kLater), mug);
  EXPECT_FALSE(identities_->identityOf(mug_.candidate(), mug, kLater, false)) << "it does not match";
}

TEST_F(IdentityResolverTest, CandidateAtTheSamePlaceIsTheObject_UnlessItIsAnotherCompleteSet) {
  const ObjectId mug = add(mug_);
  const TableItem book{5, mug_.place, RegionId{90}};  // books in a row are as close
  constexpr int kLater = 100;
  EXPECT_EQ(identities_->identityOf(book.candidate(), std::nullopt, kLater, true), mug);
  settle({setOf({mug_.region}), setOf({book.region})});
  EXPECT_FALSE(identities_->identityOf(book.candidate(), std::nullopt, kLater, true));
}

TEST_F(IdentityResolverTest, ObjectElsewhereIsAnother_WhenTheScanIsRefined) {
  const ObjectId mug = add(mug_);
  const TableItem other{mug_.seed, 2, RegionId{77}};
  constexpr int kMuchLater = 300;
  EXPECT_EQ(identities_->identityOf(other.candidate(), mug, kMuchLater, false), mug)
      << "it may have been moved";
  EXPECT_FALSE(identities_->identityOf(other.candidate(), mug, kMuchLater, true)) << "nothing moves any more";
}

TEST_F(IdentityResolverTest, ObjectsMerge_WhenAJoinByFramesPersists) {
  const ObjectId mug = add(mug_), box = add(box_);
  const int joined = frame_;
  identities_->joinRegions(mug_.region, box_.region, IdentityResolver::JoinedBy::frames, joined);
  identities_->merge(IdentityResolver::Which::held, joined + IdentityResolver::kFramesToMerge - 1);
  EXPECT_EQ(catalogue_->mergeRootOf(box), box);
  identities_->merge(IdentityResolver::Which::held, joined + IdentityResolver::kFramesToMerge);
  EXPECT_EQ(catalogue_->mergeRootOf(box), mug);
}

TEST_F(IdentityResolverTest, ObjectsStayTwo_WhenAJoinByFramesIsReverted) {
  static_cast<void>(add(mug_));
  const ObjectId box = add(box_);
  identities_->joinRegions(mug_.region, box_.region, IdentityResolver::JoinedBy::frames, frame_);
  identities_->splitRegion(mug_.region, RegionId{99});
  mergeAll();
  EXPECT_EQ(catalogue_->mergeRootOf(box), box);
}

}  // namespace
}  // namespace scantrove
