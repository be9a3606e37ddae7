// Objects that ObjectCollector adds and recognises during refinement.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "tests/pipeline/collection/object_collector_fixture.h"

namespace scantrove {
namespace {

using test::TableItem;
using testing::ElementsAre;
using testing::IsEmpty;

class RefinementTest : public test::ObjectCollectorFixture {
 protected:
  /// The item as a rated candidate.
  static Candidate rated(const TableItem& item, float objectness) {
    Candidate candidate = item.candidate();
    candidate.is_complete = false;
    candidate.objectness = objectness;
    return candidate;
  }
  /// The complete sets of the scene.
  void begin(const std::vector<CompleteSet>& complete) {
    collector_->beginRefinement();
    collector_->settleComplete(complete, [](RegionId) { return false; });
  }
  void begin(const std::vector<TableItem>& complete) {
    std::vector<CompleteSet> sets;
    for (const TableItem& item : complete) sets.push_back({{item.region}, kBestFrame});
    begin(sets);
  }
  void collectFrom(int frame_index, const std::vector<Candidate>& candidates,
                   const std::vector<TableItem>& items) {
    frame_ = frame_index;
    static_cast<void>(showCandidates(candidates, items));
  }
  void compareWith(const RenderedView& map) {
    for (const int frame : collector_->views().framesOfViews())
      collector_->views().compare(frame, map, kDepthNoise_m);
  }
  void end() {
    collector_->endRefinement();
    settle();
    static_cast<void>(collector_->applyCatalogueChanges());
  }
  [[nodiscard]] ObjectId objectOf(const TableItem& item) const {
    return collector_->objects().idOf(item.region);
  }

  static constexpr int kBestFrame = 3;
  static constexpr int kFrames = 6;  // enough to compare everything
};

TEST_F(RefinementTest, AddsCompleteSetInTheLastPass_FromItsBestFrame) {
  begin({CompleteSet{{mug_.region}, 4}});
  collectFrom(5, {rated(mug_, 2)}, {mug_});
  EXPECT_THAT(objects(), IsEmpty()) << "it can still be recognised";
  EXPECT_THAT(collector_->beginLastPass(), ElementsAre(4));
  collectFrom(5, {rated(mug_, 2)}, {mug_});
  EXPECT_THAT(objects(), IsEmpty()) << "not the best frame";
  collectFrom(4, {rated(mug_, 3)}, {mug_});
  end();
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_THAT(framesOfViews(objects()[0].id), ElementsAre(4));
}

TEST_F(RefinementTest, StoresCutOffView_OnlyInTheLastPass) {
  Candidate mug = rated(mug_, 3), box = rated(box_, 3), half_a_box = rated(box_, 4);
  mug.is_cut_off = half_a_box.is_cut_off = true;
  begin({CompleteSet{{mug_.region}, 3}, CompleteSet{{box_.region}, 4}});
  for (int frame = 3; frame < 9; ++frame) collectFrom(frame, {mug, half_a_box}, {mug_, box_});
  EXPECT_THAT(objects(), IsEmpty());
  EXPECT_THAT(collector_->beginLastPass(), ElementsAre(3, 4));
  collectFrom(3, {mug, half_a_box}, {mug_, box_});
  collectFrom(4, {mug, box}, {mug_, box_});
  end();
  ASSERT_EQ(objects().size(), 2U);
  EXPECT_THAT(framesOfViews(objectOf(mug_)), ElementsAre(3));
  EXPECT_THAT(framesOfViews(objectOf(box_)), ElementsAre(4));
}

TEST_F(RefinementTest, IgnoresRatedCandidates_OutsideOfCompleteSets) {
  begin(std::vector<TableItem>{});
  for (int i = 0; i < kFrames; ++i) static_cast<void>(showCandidates({rated(mug_, -2)}, {mug_}));
  EXPECT_THAT(collector_->beginLastPass(), IsEmpty());
  end();
  EXPECT_THAT(objects(), IsEmpty());
}

TEST_F(RefinementTest, AddsCandidatesThatAreNotRated) {
  begin(std::vector<TableItem>{});
  for (int i = 0; i < kFrames; ++i) static_cast<void>(showFrame({mug_, box_}));
  end();
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(RefinementTest, StoresViewsOfTheCompleteSet_NotOfItsParts) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  Candidate both = rated(mug_, 3);
  both.regions.add(RegionId{77});
  begin({CompleteSet{both.regions, kBestFrame}});
  for (int i = 0; i < kFrames; ++i) static_cast<void>(showCandidates({rated(mug_, 1)}, {mug_}, 60));
  EXPECT_EQ(framesOfViews(mug).size(), 1U);
  static_cast<void>(showCandidates({both}, {mug_}, 60));
  end();
  EXPECT_EQ(objects().size(), 1U);
  EXPECT_EQ(framesOfViews(mug).size(), 2U);
}

TEST_F(RefinementTest, StoresBestView_HoweverPoor_WhenNoOtherIsValid) {
  constexpr float kPoor = 0.3F;
  static_cast<void>(showFrames({mug_}));
  ASSERT_EQ(objects().size(), 1U);
  const std::vector<int> before = framesOfViews(objects()[0].id);
  begin({mug_});
  compareWith(mapWith(mug_, 0.3));
  for (int i = 0; i < kFrames; ++i) static_cast<void>(showCandidates({rated(mug_, kPoor)}, {mug_}));
  EXPECT_THAT(collector_->beginLastPass(), ElementsAre(kBestFrame));
  collectFrom(kBestFrame, {rated(mug_, kPoor)}, {mug_});
  end();
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_THAT(framesOfViews(objects()[0].id), testing::AllOf(ElementsAre(kBestFrame), testing::Ne(before)));
}

TEST_F(RefinementTest, AddsNothing_WhenAUserDeletedTheObject) {
  static_cast<void>(showFrames({mug_}));
  ASSERT_EQ(objects().size(), 1U);
  ASSERT_TRUE(person_->remove(std::array{objects()[0].id}));
  settle();
  static_cast<void>(collector_->applyCatalogueChanges());
  begin({mug_});
  for (int i = 0; i < kFrames; ++i) static_cast<void>(showCandidates({rated(mug_, 4)}, {mug_}));
  static_cast<void>(collector_->beginLastPass());
  collectFrom(kBestFrame, {rated(mug_, 4)}, {mug_});
  end();
  EXPECT_THAT(objects(), IsEmpty());
}

TEST_F(RefinementTest, NeighboringSetsStayTwoObjects) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  const TableItem book{5, mug_.place, RegionId{90}};  // books in a row are as close
  begin({mug_, book});
  for (int i = 0; i < 2 * kFrames; ++i) static_cast<void>(showCandidates({rated(book, 3)}, {book}));
  for (int i = 0; i < 3; ++i) static_cast<void>(showCandidates({rated(mug_, 4)}, {mug_}));
  EXPECT_EQ(objectOf(mug_), mug);
  EXPECT_TRUE(objectOf(book));
  EXPECT_NE(objectOf(book), mug);
  end();
  EXPECT_EQ(objects().size(), 2U) << "two objects, though never in one frame";
}

TEST_F(RefinementTest, EqualObjectsStayTwo_WhenSeenFarApart) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  for (int i = 0; i < 200; ++i) static_cast<void>(showFrame({}));
  const TableItem other{mug_.seed, 2, RegionId{77}};
  begin(std::vector<TableItem>{});
  compareWith(mapWith(mug_, 1));
  for (int i = 0; i < kFrames; ++i) static_cast<void>(showFrame({other}));
  end();
  EXPECT_EQ(objects().size(), 2U);
  EXPECT_NE(objectOf(other), mug);
}

TEST_F(RefinementTest, RecognizesANewObject_WhenOneViewIsClear) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  const TableItem unlike{9, mug_.place, mug_.region}, another{10, 1, box_.region};
  beginScan();
  ASSERT_EQ(showFrames({unlike, another}).added.size(), 2U) << "as in the first frames";
  begin({mug_, another});
  for (int i = 0; i < kFrames; ++i)
    static_cast<void>(showCandidates({rated(mug_, 3), rated(another, 3)}, {mug_, another}));
  EXPECT_EQ(objectOf(mug_), mug);
  EXPECT_NE(objectOf(another), mug);
  end();
  ASSERT_EQ(objects().size(), 2U);
  EXPECT_EQ(objects()[0].id, mug) << "it keeps its id";
}

TEST_F(RefinementTest, RecognizesNoObject_ThatTheMapHasElsewhere) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  const TableItem unlike{9, 1, box_.region}, second{mug_.seed, 1, box_.region};
  beginScan();
  collector_->bind(mug_.region, mug);  // a continued scan that has not returned there yet
  ASSERT_EQ(showFrames({unlike}).added.size(), 1U);
  begin({second});
  for (int i = 0; i < kFrames; ++i) static_cast<void>(showCandidates({rated(second, 3)}, {second}));
  EXPECT_NE(objectOf(second), mug);
  end();
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(RefinementTest, RecognizesOneOfTwoEqualObjects) {
  const ObjectId mug = showFrames({mug_}).added.at(0).id;
  const TableItem unlike{9, 0, mug_.region}, another{10, 1, box_.region}, second{mug_.seed, 1, box_.region};
  beginScan();
  ASSERT_EQ(showFrames({unlike, another}).added.size(), 2U);
  begin({mug_, second});
  for (int i = 0; i < kFrames; ++i)
    static_cast<void>(showCandidates({rated(mug_, 3), rated(second, 3)}, {mug_, second}));
  EXPECT_TRUE((objectOf(mug_) == mug) != (objectOf(second) == mug));
  end();
  EXPECT_EQ(objects().size(), 2U);
}

}  // namespace
}  // namespace scantrove
