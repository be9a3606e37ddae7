#include <gmock/gmock.h>
#include <algorithm>
#include <array>

#include "tests/pipeline/collection/object_collector_fixture.h"

namespace scantrove {
namespace {

using test::kSize;
using test::TableItem;
using ObjectCollectorTest = test::ObjectCollectorFixture;

TEST_F(ObjectCollectorTest, AddsUnknownObjectsOnce_AndViewsFromNewDirections) {
  FrameObjects first = showFrames({mug_, box_});
  ASSERT_EQ(first.added.size(), 2U);
  EXPECT_TRUE(first.recognized.empty());
  EXPECT_EQ(first.seen[0].object, first.added[0].id);
  EXPECT_EQ(first.seen[0].name, first.added[0].name);
  EXPECT_FALSE(first.seen[0].recognized);
  FrameObjects second = showFrame({mug_, box_}, 10);
  EXPECT_TRUE(second.added.empty() && second.new_views.empty());
  EXPECT_EQ(showFrame({mug_}, 25).new_views, std::vector<ObjectId>{first.added[0].id});
  EXPECT_TRUE(showFrame({mug_}, 30).new_views.empty());
  EXPECT_EQ(objects().at(0).views, 2);
  EXPECT_EQ(collected(first.added[0].id).views, 2);
  EXPECT_EQ(collector_->objects().idOf(mug_.region), first.added[0].id);
  EXPECT_FALSE(collector_->objects().idOf(RegionId{99}));
}

TEST_F(ObjectCollectorTest, StoresNoMoreViews_ThanTheParameterAllows) {
  DetectionParams few = params();
  few.max_views = 3;
  collector_->setParams(few);
  static_cast<void>(showFrames({mug_}));
  for (int i = 0; i < 6; ++i) static_cast<void>(showFrame({mug_}, 25 * i));
  EXPECT_EQ(objects().at(0).views, 3);
}

TEST_F(ObjectCollectorTest, ReportsARecognizedObjectOnce) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  beginScan();
  const FrameObjects first = showFrames({mug_, box_});
  ASSERT_EQ(first.recognized.size(), 1U);
  EXPECT_EQ(first.recognized[0].id, mug);
  EXPECT_TRUE(first.seen[0].recognized);
  EXPECT_EQ(first.added.size(), 1U);
  EXPECT_TRUE(showFrame({mug_, box_}).recognized.empty());
  const auto listed = collector_->objects().list();
  ASSERT_EQ(listed.size(), 2U);
  EXPECT_EQ(listed[0].recognized_from, "table");
  EXPECT_EQ(listed[1].recognized_from, "");
}

TEST_F(ObjectCollectorTest, AddsAnObject_WhenAKnownOneOfItsLookHasAnotherSize) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  beginScan();
  Candidate large = mug_.candidate();
  large.size_m *= 2;
  for (int i = 0; i < 30; ++i) EXPECT_TRUE(showCandidates({large}, {mug_}).recognized.empty());
  ASSERT_EQ(objects().size(), 2U);
  EXPECT_NE(collector_->objects().idOf(mug_.region), mug);
}

TEST_F(ObjectCollectorTest, FindsTheObjectAtItsPlace_UnderANewRegion) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  for (int frame = 0; frame < 20; ++frame) static_cast<void>(showFrame({}));
  const TableItem again{7, mug_.place, RegionId{77}};  // even with the appearance of another object
  EXPECT_TRUE(showFrames({again}).added.empty());
  EXPECT_EQ(collector_->objects().idOf(again.region), mug);
}

TEST_F(ObjectCollectorTest, ObjectIsNotMissing_WhenItIsHidden) {
  static_cast<void>(showFrames({mug_}));
  for (int i = 0; i < 5; ++i) showPlaceOf(mug_, 0.3F);   // a person in front of it
  for (int i = 0; i < 5; ++i) showPlaceOf(mug_, 1.01F);  // a reading of the mug itself
  for (int i = 0; i < 5; ++i) showPlaceOf(mug_, 0);
  const TableItem other{mug_.seed, 2, RegionId{77}};
  EXPECT_EQ(showFrames({other}).added.size(), 1U) << "an equal object";
}

TEST_F(ObjectCollectorTest, RecognizesAMissingObject_AtAnotherPlace) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  for (int i = 0; i < 3; ++i) showPlaceOf(mug_, 1.2F);
  const TableItem put{mug_.seed, 2, RegionId{77}};
  EXPECT_TRUE(showFrames({put}).added.empty());
  EXPECT_EQ(collector_->objects().idOf(put.region), mug);
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(ObjectCollectorTest, RecognizesAMissingObject_WhenItAppearsALittleDifferent) {
  const TableItem put{mug_.seed, 2, RegionId{77}, 0.6};
  Candidate here = put.candidate();
  const auto timesAdded = [&] {
    std::size_t added = 0;
    for (int i = 0; i < 30; ++i) added += showCandidates({here}, {put}).added.size();
    return added;
  };
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  here.has_appeared = true;
  for (int i = 0; i < 3; ++i) showPlaceOf(mug_, 1.2F);
  EXPECT_EQ(timesAdded(), 0U);
  EXPECT_EQ(collector_->objects().idOf(put.region), mug);
}

TEST_F(ObjectCollectorTest, RecognizesAMissingObject_WhenItAppearsInPart) {
  const TableItem put{mug_.seed, 2, RegionId{77}};
  Candidate part = put.candidate();
  part.size_m *= 0.55F;
  part.has_appeared = true;
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  for (int i = 0; i < 3; ++i) showPlaceOf(mug_, 1.2F);
  for (int i = 0; i < 30; ++i) EXPECT_TRUE(showCandidates({part}, {put}).added.empty());
  EXPECT_EQ(collector_->objects().idOf(put.region), mug);
  part.has_appeared = false;  // it appeared long ago, and its size is no mismatch
  for (int i = 0; i < 60; ++i) EXPECT_TRUE(showCandidates({part}, {put}).added.empty());
  EXPECT_EQ(collector_->objects().idOf(put.region), mug);
}

TEST_F(ObjectCollectorTest, LowSimilarityIsEnough_WhenOneObjectIsMissing) {
  const TableItem put{box_.seed, 2, RegionId{77}, 0, true};
  Candidate here = put.candidate();
  here.has_appeared = true;
  static_cast<void>(showFrames({mug_}));
  for (int i = 0; i < 3; ++i) showPlaceOf(mug_, 1.2F);
  for (int i = 0; i < 30; ++i) static_cast<void>(showCandidates({here}, {put}));
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(ObjectCollectorTest, HighSimilarityIsNeeded_WhenSeveralObjectsAreMissing) {
  const TableItem put{box_.seed, 2, RegionId{77}, 0, true};
  Candidate here = put.candidate();
  here.has_appeared = true;
  static_cast<void>(showFrames({mug_, box_}));
  for (int i = 0; i < 3; ++i) showPlaceOf(mug_, 1.2F);  // the box's place is in view, too
  for (int i = 0; i < 30; ++i) static_cast<void>(showCandidates({here}, {put}));
  EXPECT_EQ(objects().size(), 3U);
}

TEST_F(ObjectCollectorTest, MergesAppearedObject_WhenTheMissingOneIsNoticedLater) {
  static_cast<void>(showFrames({mug_}));
  const TableItem put{mug_.seed, 2, RegionId{77}, 0.6};
  Candidate here = put.candidate();
  here.has_appeared = true;
  for (int i = 0; i < 30; ++i) static_cast<void>(showCandidates({here}, {put}));
  ASSERT_EQ(objects().size(), 2U) << "its old place is not in view";
  for (int i = 0; i < 3; ++i) showPlaceOf(mug_, 1.2F);
  for (int i = 0; i < 3; ++i) static_cast<void>(showCandidates({here}, {put}));
  EXPECT_EQ(objects().size(), 1U);
  EXPECT_EQ(collector_->objects().idOf(put.region), collector_->objects().idOf(mug_.region));
}

TEST_F(ObjectCollectorTest, MovedObjectStays_WhenItsRegionIsJoined) {
  const TableItem box{box_.seed, 2, box_.region}, put{mug_.seed, 1, RegionId{77}};
  static_cast<void>(showFrames({mug_, box}));
  for (int i = 0; i < 3; ++i) showPlaceOf(mug_, 1.2F);
  static_cast<void>(showFrames({put}));
  ASSERT_EQ(objects().size(), 2U);
  collector_->joinRegions(box.region, put.region, ObjectCollector::JoinedBy::frames);
  for (int i = 0; i < IdentityResolver::kFramesToMerge + 5; ++i) static_cast<void>(showFrame({}));
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ObjectCollectorTest, RegionIsNoObject_WhenARemnantOfOneIsJoinedToIt) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  const RegionId beside{50};
  collector_->joinRegions(beside, mug_.region, ObjectCollector::JoinedBy::frames);
  EXPECT_FALSE(collector_->objects().idOf(beside));
  const TableItem again{mug_.seed, mug_.place, RegionId{51}};
  for (int i = 0; i < 20; ++i) static_cast<void>(showFrame({}));
  EXPECT_TRUE(showFrames({again}).added.empty()) << "its place identifies it there";
  ASSERT_TRUE(person_->setConfirmed(std::array{mug}, true));
  static_cast<void>(showFrame({again}));
  collector_->joinRegions(beside, again.region, ObjectCollector::JoinedBy::frames);
  EXPECT_EQ(collector_->objects().idOf(beside), mug) << "objects edited by a user are followed";
}

TEST_F(ObjectCollectorTest, RequestedObjectFollowsItsRegion_WhenThatIsJoined) {
  collector_->requests().request(mug_.region, {""});
  const ObjectId mug = showFrame({mug_}).added.at(0).id;
  collector_->joinRegions(RegionId{50}, mug_.region, ObjectCollector::JoinedBy::frames);
  EXPECT_EQ(collector_->objects().idOf(RegionId{50}), mug);
}

TEST_F(ObjectCollectorTest, MismatchedObjectIsStillThere) {
  static_cast<void>(showFrames({mug_}));
  Candidate larger = mug_.candidate();
  larger.size_m *= 1.5F;
  for (int i = 0; i < 10; ++i) static_cast<void>(showCandidates({larger}, {mug_}));
  larger.outline = 0.7F;
  for (int i = 0; i < 100; ++i) static_cast<void>(showCandidates({larger}, {mug_}));
  ASSERT_EQ(objects().size(), 1U);
  const TableItem other{mug_.seed, 2, RegionId{77}};
  for (int i = 0; i < 30; ++i) static_cast<void>(showCandidates({larger, other.candidate()}, {mug_, other}));
  EXPECT_EQ(objects().size(), 2U) << "an equal object";
}

TEST_F(ObjectCollectorTest, AddsAnObject_WhenNothingIsMissingOrNothingAppeared) {
  const TableItem put{mug_.seed, 2, RegionId{77}, 0.6}, later{mug_.seed, 2, RegionId{78}, 0.6};
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  Candidate here = put.candidate();
  here.has_appeared = true;
  for (int i = 0; i < 30; ++i) static_cast<void>(showCandidates({here}, {put}));
  EXPECT_EQ(objects().size(), 2U) << "the mug is in its place";
  ASSERT_TRUE(person_->remove(std::array{objects()[1].id}));
  beginScan();
  static_cast<void>(showFrames({mug_}));
  for (int i = 0; i < 3; ++i) showPlaceOf(mug_, 1.2F);
  static_cast<void>(showFrames({later}));
  EXPECT_EQ(objects().size(), 2U) << "it may have been there before";
  EXPECT_NE(collector_->objects().idOf(later.region), mug);
}

TEST_F(ObjectCollectorTest, AddsAnObject_WhenARegionIsClearlyLargerThanItsObject) {
  const ObjectId rim = showFrames({mug_}).added.at(0).id;
  Candidate larger = mug_.candidate();
  larger.size_m *= 1.5F;
  for (int i = 0; i < 60; ++i) static_cast<void>(showCandidates({larger}, {mug_}));
  ASSERT_EQ(objects().size(), 2U);
  EXPECT_NE(collector_->objects().idOf(mug_.region), rim);
  EXPECT_EQ(objects()[0].views, 1) << "the first object lost the views of the other";
}

TEST_F(ObjectCollectorTest, AcceptsAnotherSize_FromAnotherSide) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  Candidate with_another_face = mug_.candidate();
  with_another_face.size_m *= 1.35F;
  EXPECT_TRUE(showCandidates({with_another_face}, {mug_}, 21).new_views.empty());
  EXPECT_EQ(showCandidates({with_another_face}, {mug_}, 45).new_views, std::vector<ObjectId>{mug});
  for (int i = 0; i < 60; ++i) static_cast<void>(showCandidates({with_another_face}, {mug_}, 21));
  EXPECT_EQ(objects().size(), 1U) << "and it is no mismatch";
}

TEST_F(ObjectCollectorTest, FindsNoObjectUnderANewRegion_WhileItsOwnIsInView) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  const TableItem on_top{7, mug_.place, RegionId{77}};
  for (int i = 0; i < 20; ++i) static_cast<void>(showFrame({}));
  collector_->tracks().setRegionsInView({mug_.region, on_top.region});
  const FrameObjects found = showFrames({on_top});  // the mug is in view, but is no candidate
  ASSERT_EQ(found.added.size(), 1U);
  EXPECT_NE(found.added[0].id, mug);
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ObjectCollectorTest, AddsAnObject_AtThePlaceOfTwo) {
  const Candidate left = mug_.candidate();
  Candidate right = box_.candidate(), both = cup_.candidate();  // differs from both
  right.centroid_world = left.centroid_world + Eigen::Vector3f(0.06F, 0, 0);
  both.centroid_world = left.centroid_world + Eigen::Vector3f(0.03F, 0, 0);
  both.size_m *= 1.2F;
  both.regions = {mug_.region};
  both.regions.add(box_.region);
  both.odds = -3;
  for (int i = 0; i < 40; ++i) static_cast<void>(showCandidates({left, right, both}, {mug_, box_, cup_}));
  ASSERT_EQ(objects().size(), 2U);
  std::size_t added = 0, merged = 0;
  for (int i = 0; i < 9; ++i) {
    const FrameObjects one = showCandidates({both}, {cup_});
    added += one.added.size();
    merged += one.merged.size();
  }
  EXPECT_EQ(added, 1U);
  EXPECT_EQ(merged, 0U);
}

TEST_F(ObjectCollectorTest, UnclearCandidatesAreNoMismatch) {
  static_cast<void>(showFrames({mug_}));
  Candidate unclear = mug_.candidate();
  unclear.size_m *= 1.5F;
  unclear.outline = 0.7F;
  for (int i = 0; i < 60; ++i) static_cast<void>(showCandidates({unclear}, {mug_}));
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(ObjectCollectorTest, ConfirmedObjectHasNoMismatch) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  ASSERT_TRUE(person_->setConfirmed(std::array{mug}, true));
  Candidate larger = mug_.candidate();
  larger.size_m *= 1.5F;
  for (int i = 0; i < 60; ++i) static_cast<void>(showCandidates({larger}, {mug_}));
  EXPECT_EQ(objects().size(), 1U);
  EXPECT_EQ(collector_->objects().idOf(mug_.region), mug);
}

TEST_F(ObjectCollectorTest, AddsAnEqualObject_WhileTheFirstIsInPlace) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  const TableItem other{mug_.seed, 2, RegionId{77}};
  const FrameObjects seen = showFrames({mug_, other});
  ASSERT_EQ(seen.added.size(), 1U);
  EXPECT_NE(seen.added[0].id, mug);
}

TEST_F(ObjectCollectorTest, IncompleteCandidateIsAdded_WhenAUserRequestsIt) {
  Candidate part = mug_.candidate();
  part.is_complete = false;
  FrameObjects seen;
  for (int frame = 0; frame < 40; ++frame) {
    seen = showCandidates({part}, {mug_});
    EXPECT_TRUE(seen.added.empty());
  }
  ASSERT_EQ(seen.seen.size(), 1U);
  EXPECT_FALSE(seen.seen[0].object);
  collector_->requests().request(mug_.region, {""});
  seen = showCandidates({part}, {mug_});
  ASSERT_EQ(seen.added.size(), 1U);
  EXPECT_EQ(seen.seen[0].object, seen.added[0].id);
  EXPECT_TRUE(showCandidates({part}, {mug_}).added.empty()) << "once";
}

TEST_F(ObjectCollectorTest, AddsUnknownObject_AfterSeveralFrames) {
  int frames = 0;
  while (showFrame({mug_}).added.empty()) ASSERT_LT(++frames, 100);
  EXPECT_GE(frames, (RecognitionHistory::kAttemptsToGiveUp - 1) * RecognitionHistory::kFramesApart);
}

TEST_F(ObjectCollectorTest, PrefersTheKnownCandidate_WhenTwoShareRegions) {
  Candidate both = mug_.candidate();
  both.regions.add(box_.region);
  both.odds = 1;  // more likely than its parts
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  static_cast<void>(showCandidates({both, mug_.candidate()}, {mug_}));
  ASSERT_TRUE(person_->setConfirmed(std::array{mug}, true));
  const FrameObjects seen = showCandidates({mug_.candidate(), both, box_.candidate()}, {mug_, box_});
  EXPECT_EQ(std::ranges::count(seen.seen, mug, &SeenObject::object), 1);
}

TEST_F(ObjectCollectorTest, RegionsOfALargerSetStayFree_WhenOneIsAnObject) {
  ASSERT_EQ(showFrames({mug_}).added.size(), 1U);
  Candidate both = mug_.candidate();
  both.regions.add(box_.region);
  both.size_m *= 2;
  static_cast<void>(showCandidates({both}, {mug_, box_}));
  EXPECT_FALSE(collector_->objects().idOf(box_.region));
  EXPECT_EQ(showFrames({mug_, box_}).added.size(), 1U) << "the box is another object";
}

TEST_F(ObjectCollectorTest, RegionsOfARejectedSetStayFree) {
  ASSERT_EQ(showFrames({mug_}).added.size(), 1U);
  for (int i = 0; i < 20; ++i)
    static_cast<void>(showFrame({}));    // long enough to reappear under other regions
  Candidate dropped = mug_.candidate();  // at the mug's place, with its size
  dropped.regions = {RegionId{77}, box_.region};
  dropped.is_complete = false;
  dropped.outline = 0;
  static_cast<void>(showCandidates({dropped, box_.candidate()}, {box_}));
  EXPECT_FALSE(collector_->objects().idOf(RegionId{77}));
  EXPECT_EQ(showFrames({box_}).added.size(), 1U) << "the box is another object";
}

TEST_F(ObjectCollectorTest, MergesTwoObjects_AtOnePlace) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  // Observed again much later under another region, 0.3 of its size away: a second entry.
  Candidate beside = mug_.candidate();
  beside.regions = {RegionId{77}};
  beside.centroid_world.x() += 0.3F * kSize.norm();
  const TableItem other{9, mug_.place, RegionId{77}};
  for (int frame = 0; frame < 20; ++frame) static_cast<void>(showFrame({}));
  ObjectId second;
  for (int frame = 0; frame < 40 && !second; ++frame) {
    const FrameObjects seen = showCandidates({beside}, {other});
    if (!seen.added.empty()) second = seen.added[0].id;
  }
  ASSERT_TRUE(second);
  ASSERT_NE(second, mug);
  // A better observation is at the place of the first.
  beside.centroid_world = mug_.centroid();
  std::vector<ObjectMerge> merged;
  for (int frame = 0; frame < 5; ++frame)
    std::ranges::copy(showCandidates({beside}, {other}).merged, std::back_inserter(merged));
  ASSERT_EQ(merged.size(), 1U);
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(ObjectCollectorTest, ObjectsSeenInOneFrameStayTwo) {
  const FrameObjects first = showFrames({mug_, box_});
  ASSERT_EQ(first.added.size(), 2U);
  Candidate moved = box_.candidate();
  moved.centroid_world = mug_.centroid();
  for (int frame = 0; frame < 30; ++frame) EXPECT_TRUE(showCandidates({moved}, {box_}).merged.empty());
  EXPECT_EQ(objects().size(), 2U);
}

}  // namespace
}  // namespace scantrove
