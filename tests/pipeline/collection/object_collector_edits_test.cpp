#include <array>
#include <map>

#include "core/collection/candidate_crop.h"
#include "tests/pipeline/collection/object_collector_fixture.h"

namespace scantrove {
namespace {

using test::TableItem;
using ObjectCollectorEditsTest = test::ObjectCollectorFixture;

TEST_F(ObjectCollectorEditsTest, DeletedObjectIsNotAddedAgain_AndReturnsWhenRestored) {
  const ObjectId mug = showFrames({mug_, box_}).added.at(0).id;
  ASSERT_TRUE(person_->remove(std::array{mug}));
  const TableItem under_a_new_region{mug_.seed, mug_.place, RegionId{77}};
  for (int frame = 0; frame < 20; ++frame) {
    const FrameObjects seen = showFrame({mug_, box_}, 25 * frame);
    EXPECT_TRUE(seen.added.empty() && seen.recognized.empty());
    EXPECT_FALSE(seen.seen[0].object);
    EXPECT_EQ(seen.seen[0].name, "");
  }
  for (int frame = 0; frame < 20; ++frame) static_cast<void>(showFrame({}));
  for (int frame = 0; frame < 40; ++frame)
    EXPECT_TRUE(showFrame({under_a_new_region, box_}, 25 * frame).added.empty());
  EXPECT_EQ(objects().size(), 1U);
  EXPECT_EQ(collector_->objects().list().size(), 1U);
  ASSERT_TRUE(person_->restore(std::array{mug}));
  const FrameObjects restored = showFrame({mug_});
  EXPECT_EQ(restored.seen[0].object, mug);
  EXPECT_TRUE(restored.added.empty());
  EXPECT_EQ(collector_->objects().idOf(under_a_new_region.region), mug);
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ObjectCollectorEditsTest, NamesAndConfirmationsShow_InTheNextFrame) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  ASSERT_TRUE(person_->rename(mug, "my mug"));
  ASSERT_TRUE(person_->setConfirmed(std::array{mug}, true));
  const FrameObjects seen = showFrame({mug_});
  EXPECT_EQ(seen.seen[0].name, "my mug");
  EXPECT_TRUE(seen.seen[0].confirmed);
}

TEST_F(ObjectCollectorEditsTest, MergeByAUserIsFollowed_AndItsUndo) {
  const FrameObjects first = showFrames({mug_, box_});
  const ObjectId mug = first.added.at(0).id, box = first.added.at(1).id;
  const Result<ObjectMerge> merge = person_->merge(std::array{mug, box});
  ASSERT_TRUE(merge);
  FrameObjects seen = showFrame({mug_, box_});
  EXPECT_EQ(seen.seen[0].object, merge->into);
  EXPECT_EQ(seen.seen[1].object, merge->into);
  EXPECT_EQ(collector_->objects().list().size(), 1U);
  // A view of the merged part goes with it when the merge is undone.
  EXPECT_EQ(showFrame({mug_, box_}, 30).new_views.size(), 1U) << "the same direction of one object";
  ASSERT_TRUE(person_->unmerge(*merge));
  seen = showFrame({mug_, box_}, 60);
  EXPECT_EQ(seen.seen[0].object, mug);
  EXPECT_EQ(seen.seen[1].object, box);
  EXPECT_EQ(collector_->objects().list().size(), 2U);
}

TEST_F(ObjectCollectorEditsTest, JoinedRegionsMerge_UnlessAUserUndidThat) {
  const FrameObjects first = showFrames({mug_, box_});
  const ObjectId mug = first.added.at(0).id, box = first.added.at(1).id;
  collector_->joinRegions(mug_.region, box_.region);
  const FrameObjects joined = showFrame({mug_});
  ASSERT_EQ(joined.merged.size(), 1U);
  EXPECT_EQ(joined.merged[0].into, mug) << "the older of equals";
  EXPECT_EQ(joined.seen[0].object, mug);
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].views, 2);
  ASSERT_TRUE(person_->unmerge(joined.merged[0]));
  for (int frame = 0; frame < 20; ++frame) static_cast<void>(showFrame({mug_}));
  const TableItem box_again{box_.seed, box_.place, RegionId{99}};
  EXPECT_EQ(showFrame({mug_, box_again}).seen[1].object, box);
  collector_->joinRegions(mug_.region, box_again.region);
  EXPECT_TRUE(showFrame({mug_}).merged.empty());
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ObjectCollectorEditsTest, ObjectsMerge_WhenAJoinByFramesPersists) {
  static_cast<void>(showFrames({mug_, box_}));
  collector_->joinRegions(mug_.region, box_.region, ObjectCollector::JoinedBy::frames);
  for (int i = 0; i < IdentityResolver::kFramesToMerge - 1; ++i)
    EXPECT_TRUE(showFrame({mug_}).merged.empty()) << i;
  std::size_t merged = 0;
  for (int i = 0; i < 3; ++i) merged += showFrame({mug_}).merged.size();
  EXPECT_EQ(merged, 1U);
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(ObjectCollectorEditsTest, ObjectsStayTwo_WhenAJoinByFramesIsReverted) {
  const FrameObjects first = showFrames({mug_, box_});
  collector_->joinRegions(mug_.region, box_.region, ObjectCollector::JoinedBy::frames);
  for (int i = 0; i < 20; ++i) static_cast<void>(showFrame({mug_}));
  const TableItem box_again{box_.seed, box_.place, RegionId{99}};
  collector_->splitRegion(mug_.region, box_again.region);
  for (int i = 0; i < 2 * IdentityResolver::kFramesToMerge; ++i)
    EXPECT_TRUE(showFrame({mug_, box_again}).merged.empty());
  EXPECT_EQ(objects().size(), 2U);
  EXPECT_EQ(collector_->objects().idOf(mug_.region), first.added.at(0).id);
  EXPECT_EQ(collector_->objects().idOf(box_again.region), first.added.at(1).id);
}

TEST_F(ObjectCollectorEditsTest, ObjectStays_WhenOnlyAPartOfItIsJoined) {
  const RegionId handle{14};
  Candidate mug = mug_.candidate();
  mug.regions.add(handle);
  for (int i = 0; i < 40; ++i) static_cast<void>(showCandidates({mug, box_.candidate()}, {mug_, box_}));
  ASSERT_EQ(objects().size(), 2U);
  collector_->joinRegions(box_.region, handle, ObjectCollector::JoinedBy::frames);
  static_cast<void>(showFrame({mug_, box_}));
  ASSERT_TRUE(collector_->finish([](const FrameObjects&) {}));
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ObjectCollectorEditsTest, JoinedRegionsMerge_WhenTheScanEnds) {
  static_cast<void>(showFrames({mug_, box_}));
  collector_->joinRegions(mug_.region, box_.region, ObjectCollector::JoinedBy::frames);
  static_cast<void>(showFrame({mug_}));
  ASSERT_TRUE(collector_->finish([](const FrameObjects&) {}));
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(ObjectCollectorEditsTest, ObjectsThatUsersEditedStayTwo_WhenTheirRegionsJoin) {
  const FrameObjects first = showFrames({mug_, box_, cup_});
  ASSERT_TRUE(person_->rename(first.added.at(0).id, "my mug"));
  ASSERT_TRUE(person_->setConfirmed(std::array{first.added.at(1).id}, true));
  static_cast<void>(showFrame({mug_, box_, cup_}));
  collector_->joinRegions(mug_.region, box_.region);
  EXPECT_TRUE(showFrame({mug_, cup_}).merged.empty());
  // A merge with an object that no user edited keeps the name.
  collector_->joinRegions(cup_.region, mug_.region);
  ASSERT_EQ(showFrame({cup_}).merged.size(), 1U);
  EXPECT_EQ(collected(collector_->objects().idOf(cup_.region)).name, "my mug");
}

TEST_F(ObjectCollectorEditsTest, SettledObjectsMerge_WhenAUserJoinsTheirRegions_AndPartWithTheUndo) {
  constexpr int kOperation = 7;
  const FrameObjects first = showFrames({mug_, box_});
  const ObjectId mug = first.added.at(0).id, box = first.added.at(1).id;
  ASSERT_TRUE(person_->rename(box, "my box"));
  ASSERT_TRUE(person_->setConfirmed(std::array{mug}, true));
  static_cast<void>(showFrame({mug_, box_}));
  const std::map<RegionId, ObjectId> before{{mug_.region, collector_->objects().keyOf(mug_.region)},
                                            {box_.region, collector_->objects().keyOf(box_.region)}};
  collector_->joinRegions(mug_.region, box_.region, ObjectCollector::JoinedBy::user, kOperation);
  const FrameObjects joined = showFrame({mug_});
  ASSERT_EQ(joined.merged.size(), 1U);
  EXPECT_EQ(joined.merged[0].into, box) << "a user named it";
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].name, "my box");
  EXPECT_TRUE(objects()[0].confirmed) << "as one of the two was";
  EXPECT_EQ(objects()[0].views, 2);

  collector_->splitRegion(mug_.region, box_.region);
  collector_->partRegions(kOperation, before, {});
  static_cast<void>(showFrame({mug_, box_}));
  const FrameObjects parted = showFrame({mug_, box_});
  EXPECT_EQ(parted.seen[0].object, mug);
  EXPECT_EQ(parted.seen[1].object, box);
  ASSERT_EQ(objects().size(), 2U);
  EXPECT_FALSE(objects()[1].confirmed) << "it was not before";
  EXPECT_EQ(objects()[1].name, "my box");

  // A join that is redone merges them, though a user parted them.
  collector_->joinRegions(mug_.region, box_.region, ObjectCollector::JoinedBy::user, kOperation);
  EXPECT_EQ(showFrame({mug_}).merged.size(), 1U);
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(ObjectCollectorEditsTest, MergesOfAnEarlierScanPart_WhenTheirJoinIsUndone) {
  const FrameObjects first = showFrames({mug_, box_});
  const ObjectId mug = first.added.at(0).id, box = first.added.at(1).id;
  const Result<ObjectMerge> earlier = person_->merge(std::array{mug, box});
  ASSERT_TRUE(earlier);
  static_cast<void>(showFrame({mug_, box_}));
  constexpr int kOperation = 3;
  collector_->partRegions(kOperation, {}, {*earlier});
  static_cast<void>(showFrame({mug_, box_}));
  static_cast<void>(showFrame({mug_, box_}));
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ObjectCollectorEditsTest, JoinedRegionIsTheOtherObject_WhenItsOwnWasDeleted) {
  const FrameObjects first = showFrames({mug_, box_});
  ASSERT_TRUE(person_->remove(std::array{first.added.at(0).id}));
  static_cast<void>(showFrame({}));
  collector_->joinRegions(mug_.region, box_.region);
  EXPECT_TRUE(showFrame({mug_}).merged.empty());
  EXPECT_EQ(collector_->objects().idOf(mug_.region), first.added.at(1).id);
}

TEST_F(ObjectCollectorEditsTest, ObjectOfAnotherProgramIsRecognized) {
  static_cast<void>(showFrames({box_}));
  const Candidate candidate = mug_.candidate();
  RgbdFrame frame;
  frame.color = cv::Mat(240, 320, CV_8UC3, cv::Scalar(90, 20, 10));
  frame.depth = cv::Mat(240, 320, CV_16UC1, cv::Scalar(1000));
  mug_.paint(frame.color);
  const Result<ObjectRecord> other =
      person_->addObject(*cropView(frame, Eigen::Isometry3d::Identity(), inColor(), candidate));
  ASSERT_TRUE(other);
  const FrameObjects seen = showFrames({mug_});
  ASSERT_EQ(seen.recognized.size(), 1U);
  EXPECT_EQ(seen.recognized[0].id, other->id);
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ObjectCollectorEditsTest, PartsOfADeletedObjectAreNotAdded) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  ASSERT_TRUE(person_->remove(std::array{mug}));
  static_cast<void>(showFrame({mug_}));
  TableItem handle{4, 2, RegionId{78}};
  collector_->splitRegion(mug_.region, handle.region);
  EXPECT_TRUE(showFrames({handle}).added.empty());
  handle.region = RegionId{79};
  EXPECT_EQ(showFrames({{5, 1, RegionId{80}}}).added.size(), 1U) << "an item that is no part is added";
}

}  // namespace
}  // namespace scantrove
