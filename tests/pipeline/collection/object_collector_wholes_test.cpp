// What ObjectCollector makes of the sets of regions that the looks at the end of a scan say are whole.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/pipeline/collection/second_look_fixture.h"

namespace scantrove {
namespace {

using test::Thing;

/// The thing, as one of the last looks shows it.
Candidate judged(const Thing& thing, float objectness) {
  Candidate candidate = thing.candidate();
  candidate.is_complete = false;
  candidate.objectness = objectness;
  return candidate;
}

class Wholes : public test::SecondLookFixture {
 protected:
  /// Mug and box, both wholes and both taken for `object`, part: it is the mug, the likelier one.
  void expectTwoOf(ObjectId object) {
    collector_->beginRefinement();
    rate(3, {judged(mug_, 4), judged(box_, 3)});
    settleComplete();
    EXPECT_EQ(collector_->objects().idOf(mug_.region), object);
    EXPECT_FALSE(collector_->objects().idOf(box_.region));
    collector_->endRefinement();
  }
};

TEST_F(Wholes, AWholeBecomesAnObjectByItsBestLookAtTheLatest) {
  collector_->beginRefinement();
  rate(3, {judged(mug_, 1)});
  rate(4, {judged(mug_, 3)});
  rate(5, {judged(mug_, 2)});
  settleComplete();
  EXPECT_THAT(collector_->views().framesOfViews(), testing::IsEmpty()) << "no views were kept";
  frame_ = 5;
  static_cast<void>(lookAt({judged(mug_, 2)}, {mug_}));
  EXPECT_TRUE(objects().empty()) << "it may yet be recognised";
  EXPECT_THAT(collector_->beginLastPass(), testing::ElementsAre(4));
  frame_ = 5;
  static_cast<void>(lookAt({judged(mug_, 2)}, {mug_}));
  EXPECT_TRUE(objects().empty()) << "not the best look";
  frame_ = 4;
  static_cast<void>(lookAt({judged(mug_, 3)}, {mug_}));
  collector_->endRefinement();
  settle();
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_THAT(framesOfViews(objects()[0].id), testing::ElementsAre(4));
}

TEST_F(Wholes, WhatTheImageCutsOffIsNoViewUnlessThereIsNoBetterLook) {
  Candidate mug = judged(mug_, 3), box = judged(box_, 3), half_a_box = judged(box_, 4);
  mug.is_cut_off = half_a_box.is_cut_off = true;
  collector_->beginRefinement();
  rate(3, {mug, half_a_box});
  rate(4, {mug, box});
  settleComplete();
  for (frame_ = 3; frame_ < 9; ++frame_) static_cast<void>(lookAt({mug, half_a_box}, {mug_, box_}));
  EXPECT_TRUE(objects().empty());
  EXPECT_THAT(collector_->beginLastPass(), testing::ElementsAre(3, 4));
  frame_ = 3;
  static_cast<void>(lookAt({mug, half_a_box}, {mug_, box_}));
  frame_ = 4;
  static_cast<void>(lookAt({mug, box}, {mug_, box_}));
  collector_->endRefinement();
  settle();
  ASSERT_EQ(objects().size(), 2U);
  EXPECT_THAT(framesOfViews(collector_->objects().idOf(mug_.region)), testing::ElementsAre(3));
  EXPECT_THAT(framesOfViews(collector_->objects().idOf(box_.region)), testing::ElementsAre(4));
}

TEST_F(Wholes, APartThatWasRatedBecomesAnObjectAsTheRegionThatItIsThen) {
  const RegionId part{501}, rest{502};
  Candidate rated = judged(mug_, 3);
  rated.regions = {part};
  Candidate of_rest = judged(box_, -2);
  of_rest.regions = {rest};
  collector_->beginRefinement();
  rate(3, {rated, of_rest});
  rated_.rename([&](const RegionSet& regions) -> std::optional<RegionSet> {
    if (regions == RegionSet{part}) return RegionSet{mug_.region};
    return std::nullopt;
  });
  settleComplete();
  EXPECT_THAT(collector_->beginLastPass(), testing::ElementsAre(3));
  frame_ = 3;
  static_cast<void>(lookAt({judged(mug_, 3)}, {mug_}));
  collector_->endRefinement();
  settle();
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(collector_->objects().idOf(mug_.region), objects()[0].id);
}

TEST_F(Wholes, RegionsOfWhatAPersonSpokeOfOrDeletedStay) {
  static_cast<void>(study({mug_, box_, Thing{33, 2, RegionId{77}}}));
  ASSERT_TRUE(person_->rename(collector_->objects().idOf(box_.region), "my box"));
  ASSERT_TRUE(person_->remove(std::array{collector_->objects().idOf(RegionId{77})}));
  settle();
  static_cast<void>(collector_->followCatalogue());
  EXPECT_TRUE(collector_->requests().isFixed(box_.region));
  EXPECT_TRUE(collector_->requests().isFixed(RegionId{77})) << "or its parts would be found again";
  EXPECT_FALSE(collector_->requests().isFixed(mug_.region));
  EXPECT_FALSE(collector_->requests().isFixed(RegionId{999})) << "it is nothing yet";
}

TEST_F(Wholes, WhatIsUnlikelyToBeAWholeIsNoneHoweverOftenItIsSeen) {
  collector_->beginRefinement();
  rate(3, {judged(mug_, -2)});
  settleComplete();
  for (int i = 0; i < 6; ++i) static_cast<void>(lookAt({judged(mug_, -2)}, {mug_}));
  EXPECT_THAT(collector_->beginLastPass(), testing::IsEmpty());
  collector_->endRefinement();
  settle();
  EXPECT_TRUE(objects().empty());
}

TEST_F(Wholes, AnObjectOfThisScanThatIsUnlikelyToBeOneLeavesUnlessAPersonSpokeOfIt) {
  static_cast<void>(study({mug_, box_}));
  ASSERT_EQ(objects().size(), 2U);
  const ObjectId box = collector_->objects().idOf(box_.region);
  ASSERT_TRUE(person_->rename(box, "my box"));
  settle();
  static_cast<void>(collector_->followCatalogue());
  collector_->beginRefinement();
  rate(3, {judged(mug_, -2), judged(box_, -2)});
  settleComplete();
  collector_->endRefinement();
  settle();
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].id, box);
}

TEST_F(Wholes, WhatIsAWholeInTheEndWasNotReplaced) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  Candidate with_more = mug_.candidate();
  with_more.size_m *= 1.5F;
  for (int i = 0; i < 60; ++i) static_cast<void>(lookAt({with_more}, {mug_}, 60));
  ASSERT_EQ(objects().size(), 2U) << "the region grew, and the mug is thought to have been a part of that";
  const Thing again{mug_.seed, mug_.place, RegionId{77}};
  for (int i = 0; i < 20; ++i) static_cast<void>(look({}));
  static_cast<void>(study({again}));
  ASSERT_EQ(collector_->objects().idOf(again.region), mug) << "and yet there it is";
  collector_->beginRefinement();
  rate(3, {judged(again, 3), judged(mug_, 3)});
  settleComplete();
  collector_->endRefinement();
  settle();
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(Wholes, WhatAPersonMergedOrBroughtBackStaysHoweverUnlikely) {
  const Thing can{7, 2, RegionId{78}};
  static_cast<void>(study({mug_, box_, can}));
  const ObjectId mug = collector_->objects().idOf(mug_.region), box = collector_->objects().idOf(box_.region),
                 back = collector_->objects().idOf(can.region);
  ASSERT_TRUE(mug && box && back);
  ASSERT_TRUE(person_->merge(std::array{mug, box}));
  ASSERT_TRUE(person_->remove(std::array{back}));
  ASSERT_TRUE(person_->restore(std::array{back}));
  settle();
  static_cast<void>(collector_->followCatalogue());
  collector_->beginRefinement();
  rate(3, {judged(mug_, -2), judged(box_, -2), judged(can, -2)});
  settleComplete();
  collector_->endRefinement();
  settle();
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(Wholes, WhatTheLastLooksDoNotShowStays) {
  static_cast<void>(study({mug_}));
  collector_->beginRefinement();
  rate(3, {judged(box_, -2)});
  settleComplete();
  collector_->endRefinement();
  settle();
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(Wholes, AnObjectIsTheWholeThatItsRegionIsAPartOf) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  const RegionId handle{77};
  Candidate both = judged(mug_, 3);
  both.regions.add(handle);
  collector_->beginRefinement();
  rate(3, {judged(mug_, 2), both});
  settleComplete();
  EXPECT_EQ(collector_->objects().idOf(handle), mug);
  for (int i = 0; i < 6; ++i) static_cast<void>(lookAt({judged(mug_, 1)}, {mug_}, 60));
  EXPECT_EQ(framesOfViews(mug).size(), 1U) << "a part of it is no view of it";
  static_cast<void>(lookAt({both}, {mug_}, 60));
  collector_->endRefinement();
  settle();
  EXPECT_EQ(objects().size(), 1U);
  EXPECT_EQ(framesOfViews(mug).size(), 2U);
}

TEST_F(Wholes, AViewOfOneRegionOfAWholeGivesWayToOneOfAll) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  const std::vector<int> before = framesOfViews(mug);
  const RegionId handle{77};
  Candidate both = judged(mug_, 3);
  both.regions.add(handle);
  RenderedView map = mapWith(mug_, 1);
  // Beside it and nearly as large: the mug alone is still the larger part, of a little more than half.
  const cv::Rect box_px = mug_.candidate().box_px;
  for (int v = box_px.y; v < box_px.br().y; ++v) {
    const auto beside = map.regions.begin() + v * map.K.width + box_px.br().x;
    std::fill_n(beside, 9 * box_px.width / 10, handle);
  }
  collector_->beginRefinement();
  rate(3, {both});
  settleComplete();
  for (const int frame : collector_->views().framesOfViews())
    collector_->views().compare(frame, map, 0.0015F);
  for (int i = 0; i < 6; ++i) static_cast<void>(lookAt({both}, {mug_}));
  collector_->endRefinement();
  settle();
  EXPECT_EQ(objects().size(), 1U);
  EXPECT_EQ(framesOfViews(mug).size(), 1U) << "from the same side";
  EXPECT_NE(framesOfViews(mug), before);
}

TEST_F(Wholes, TwoWholesAreTwoObjectsThoughTheirRegionsWereTakenForOne) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  collector_->bind(box_.region, mug);
  expectTwoOf(mug);
}

TEST_F(Wholes, AWholeIsNotTheOneThatStandsWhereItDoes) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  const Thing book{5, mug_.place, RegionId{90}};  // books in a row are as near
  collector_->beginRefinement();
  rate(3, {judged(mug_, 4), judged(book, 3)});
  settleComplete();
  for (int i = 0; i < 12; ++i) static_cast<void>(lookAt({judged(book, 3)}, {book}));
  for (int i = 0; i < 3; ++i) static_cast<void>(lookAt({judged(mug_, 4)}, {mug_}));
  EXPECT_EQ(collector_->objects().idOf(mug_.region), mug);
  EXPECT_TRUE(collector_->objects().idOf(book.region));
  EXPECT_NE(collector_->objects().idOf(book.region), mug);
  collector_->endRefinement();
  settle();
  EXPECT_EQ(objects().size(), 2U) << "never seen side by side, and yet two";
}

TEST_F(Wholes, TwoWholesAreTwoObjectsThoughTheScanMadeOneOfWhatTheyWereTakenFor) {
  static_cast<void>(study({mug_, box_}));
  const ObjectId mug = collector_->objects().idOf(mug_.region), box = collector_->objects().idOf(box_.region);
  collector_->joinRegions(mug_.region, box_.region);
  static_cast<void>(look({mug_}));
  ASSERT_EQ(objects().size(), 1U);
  collector_->bind(box_.region, box);  // the regions part again
  ASSERT_EQ(collector_->objects().idOf(box_.region), mug);
  expectTwoOf(mug);
}

TEST_F(Wholes, AWholeWithoutAViewThatCountsHasItsBestLookHoweverPoor) {
  constexpr float kPoor = 0.3F;
  static_cast<void>(study({mug_}));
  ASSERT_EQ(objects().size(), 1U);
  const std::vector<int> before = framesOfViews(objects()[0].id);
  collector_->beginRefinement();
  rate(3, {judged(mug_, kPoor)});
  settleComplete();
  for (const int frame : collector_->views().framesOfViews())
    collector_->views().compare(frame, mapWith(mug_, 0.3), 0.0015F);
  for (int i = 0; i < 6; ++i) static_cast<void>(lookAt({judged(mug_, kPoor)}, {mug_}));
  EXPECT_THAT(collector_->beginLastPass(), testing::ElementsAre(3));
  frame_ = 3;
  static_cast<void>(lookAt({judged(mug_, kPoor)}, {mug_}));
  collector_->endRefinement();
  settle();
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_THAT(framesOfViews(objects()[0].id), testing::AllOf(testing::ElementsAre(3), testing::Ne(before)));
}

TEST_F(Wholes, WhatWasTakenForNewIsKnownAgainByAClearLookInTheEnd) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  const Thing unlike{9, mug_.place, mug_.region}, another{10, 1, box_.region};
  beginScan();
  ASSERT_EQ(study({unlike, another}).added.size(), 2U) << "as the first looks show them";
  collector_->beginRefinement();
  rate(3, {judged(mug_, 3), judged(another, 3)});
  settleComplete();
  for (int i = 0; i < 6; ++i)
    static_cast<void>(lookAt({judged(mug_, 3), judged(another, 3)}, {mug_, another}));
  EXPECT_EQ(collector_->objects().idOf(mug_.region), mug);
  EXPECT_NE(collector_->objects().idOf(another.region), mug);
  collector_->endRefinement();
  settle();
  ASSERT_EQ(objects().size(), 2U);
  EXPECT_EQ(objects()[0].id, mug) << "it keeps its number";
}

TEST_F(Wholes, WhatTheMapHasElsewhereIsNotWhatWasTakenForNew) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  const Thing unlike{9, 1, box_.region}, second{mug_.seed, 1, box_.region};
  beginScan();
  collector_->bind(mug_.region, mug);  // a scan that goes on, and has not been back there yet
  ASSERT_EQ(study({unlike}).added.size(), 1U);
  collector_->beginRefinement();
  rate(3, {judged(second, 3)});
  settleComplete();
  for (int i = 0; i < 6; ++i) static_cast<void>(lookAt({judged(second, 3)}, {second}));
  EXPECT_NE(collector_->objects().idOf(second.region), mug);
  collector_->endRefinement();
  settle();
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(Wholes, OfTwoOfAKindOnlyOneIsTheOneThatWasKnown) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  const Thing unlike{9, 0, mug_.region}, another{10, 1, box_.region}, second{mug_.seed, 1, box_.region};
  beginScan();
  ASSERT_EQ(study({unlike, another}).added.size(), 2U);
  collector_->beginRefinement();
  rate(3, {judged(mug_, 3), judged(second, 3)});
  settleComplete();
  for (int i = 0; i < 6; ++i) static_cast<void>(lookAt({judged(mug_, 3), judged(second, 3)}, {mug_, second}));
  EXPECT_TRUE((collector_->objects().idOf(mug_.region) == mug) !=
              (collector_->objects().idOf(second.region) == mug));
  collector_->endRefinement();
  settle();
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(Wholes, TwoWholesAreOneObjectWhereAPersonMergedThem) {
  static_cast<void>(study({mug_, box_}));
  const ObjectId mug = collector_->objects().idOf(mug_.region), box = collector_->objects().idOf(box_.region);
  ASSERT_TRUE(person_->merge(std::array{mug, box}));  // neither is named or confirmed
  settle();
  static_cast<void>(collector_->followCatalogue());
  collector_->beginRefinement();
  rate(3, {judged(mug_, 4), judged(box_, 3)});
  settleComplete();
  EXPECT_EQ(collector_->objects().idOf(mug_.region), mug);
  EXPECT_EQ(collector_->objects().idOf(box_.region), mug);
  collector_->endRefinement();
}

TEST_F(Wholes, WhatAPersonDeletedIsNotFoundAgain) {
  static_cast<void>(study({mug_}));
  ASSERT_EQ(objects().size(), 1U);
  ASSERT_TRUE(person_->remove(std::array{objects()[0].id}));
  settle();
  static_cast<void>(collector_->followCatalogue());
  collector_->beginRefinement();
  rate(3, {judged(mug_, 4)});
  settleComplete();
  for (int i = 0; i < 6; ++i) static_cast<void>(lookAt({judged(mug_, 4)}, {mug_}));
  static_cast<void>(collector_->beginLastPass());
  frame_ = 3;
  static_cast<void>(lookAt({judged(mug_, 4)}, {mug_}));
  collector_->endRefinement();
  settle();
  EXPECT_TRUE(objects().empty());
}

TEST_F(Wholes, WhatAPersonKeepsApartIsNotOneWhole) {
  static_cast<void>(study({mug_, box_}));
  const ObjectId mug = collector_->objects().idOf(mug_.region), box = collector_->objects().idOf(box_.region);
  ASSERT_TRUE(person_->rename(mug, "my mug"));
  ASSERT_TRUE(person_->rename(box, "my box"));
  settle();
  static_cast<void>(collector_->followCatalogue());
  Candidate both = judged(mug_, 3);
  both.regions.add(box_.region);
  collector_->beginRefinement();
  rate(3, {both});
  settleComplete();
  EXPECT_EQ(collector_->objects().idOf(mug_.region), mug);
  EXPECT_EQ(collector_->objects().idOf(box_.region), box);
  collector_->endRefinement();
}

}  // namespace
}  // namespace scantrove
