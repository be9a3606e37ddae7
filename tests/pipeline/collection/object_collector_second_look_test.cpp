// What ObjectCollector does at the end of a scan, when everything is looked at again.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "tests/pipeline/collection/second_look_fixture.h"

namespace scantrove {
namespace {

using test::Thing;

class SecondLook : public test::SecondLookFixture {};

TEST_F(SecondLook, ViewsThatShowTheirObjectStay) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  const std::vector<int> before = framesOfViews(mug);
  lookAgain(mapWith(mug_, 0.8), {});
  EXPECT_EQ(framesOfViews(mug), before);
  EXPECT_TRUE(collector_->views().camerasOfViews(12345).empty());
}

TEST_F(SecondLook, ViewsAreHeldAgainstAMapOfTheirOwnSizeAlone) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  const std::vector<int> before = framesOfViews(mug);
  RenderedView closer;
  closer.K = test::kWorking.resizedTo(2 * test::kWorking.width, 2 * test::kWorking.height);
  closer.regions.resize(4 * static_cast<std::size_t>(test::kWorking.pixels()));
  lookAgain(closer, {mug_});
  EXPECT_EQ(framesOfViews(mug), before);
  lookAgain(mapWith(mug_, 0.5), {mug_});
  EXPECT_NE(framesOfViews(mug), before) << "half of the mug is on a map of that size";
}

TEST_F(SecondLook, AViewOfWhatTheRegionWasOnceGivesWayToOneOfWhatItIs) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  const std::vector<int> before = framesOfViews(mug);
  ASSERT_EQ(before.size(), 1U);
  lookAgain(mapWith(mug_, 0.5), {mug_});
  const std::vector<int> after = framesOfViews(mug);
  ASSERT_EQ(after.size(), 1U);
  EXPECT_GT(after[0], before[0]) << "from the same side";
  EXPECT_EQ(objects().size(), 1U);
  EXPECT_EQ(collected(mug).views, 1) << "also as the scan reports it";
}

TEST_F(SecondLook, WhatNoViewShowsAnyMoreIsNoObject) {
  static_cast<void>(study({mug_, box_}));
  lookAgain(mapWith(box_, 1), {});
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(collector_->objects().idOf(mug_.region), ObjectId{});
  EXPECT_EQ(collector_->objects().idOf(box_.region), objects()[0].id);
}

TEST_F(SecondLook, WhatWasTakenAwayIsAsItWas) {
  static_cast<void>(study({mug_}));
  lookAgain(mapWith(mug_, 0.2), {}, 1.2F);
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(SecondLook, AViewWithSomethingThatLeftGoesWhereTheObjectIsThereAllTheSame) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  const std::vector<int> before = framesOfViews(mug);
  lookAgain(mapWith(mug_, 0.2), {mug_}, 1.2F, 60);
  const std::vector<int> after = framesOfViews(mug);
  ASSERT_EQ(after.size(), 1U);
  EXPECT_NE(after, before) << "the one from another side, that the second look found";
}

TEST_F(SecondLook, WhatWasTakenForSomethingElseAtFirstGoesEvenIfItWasTakenAwayLater) {
  static_cast<void>(study({mug_}));
  Candidate alone = mug_.candidate();
  alone.size_m *= 0.6F;  // the first look had something beside it
  for (int i = 0; i < 60; ++i) static_cast<void>(lookAt({alone}, {mug_}));
  ASSERT_EQ(objects().size(), 2U);
  const ObjectId mug = collector_->objects().idOf(mug_.region);
  lookAgain(mapWith(mug_, 0.2), {}, 1.2F);
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].id, mug);
}

TEST_F(SecondLook, WhatWasDoubtedAndIsThereAllTheSameIsWhatTookItsPlace) {
  static_cast<void>(study({mug_}));
  Candidate larger = mug_.candidate();
  larger.size_m *= 1.5F;
  for (int i = 0; i < 60; ++i) static_cast<void>(lookAt({larger}, {mug_}, 60));
  ASSERT_EQ(objects().size(), 2U);
  lookAgain(mapWith(mug_, 1), {});
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].views, 2) << "of both";
}

TEST_F(SecondLook, WhatAPersonDeletesDoesNotLiveOnInWhatItTookThePlaceOf) {
  static_cast<void>(study({mug_}));
  Candidate larger = mug_.candidate();
  larger.size_m *= 1.5F;
  for (int i = 0; i < 60; ++i) static_cast<void>(lookAt({larger}, {mug_}, 60));
  ASSERT_EQ(objects().size(), 2U);
  ASSERT_TRUE(person_->remove(std::array{objects()[1].id}));
  settle();
  static_cast<void>(collector_->followCatalogue());
  lookAgain(mapWith(mug_, 1), {});
  EXPECT_TRUE(objects().empty());
}

TEST_F(SecondLook, AViewOfAPartIsNoneOfTheWhole) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  const RegionId rest{14};
  RenderedView map = mapWith(mug_, 1);
  std::fill(map.regions.end() - 30 * map.K.width, map.regions.end(), rest);
  collector_->bind(rest, mug);
  lookAgain(map, {});
  EXPECT_TRUE(objects().empty());
}

TEST_F(SecondLook, WhatAPersonSaidSomethingOfIsLeftAlone) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  ASSERT_TRUE(person_->rename(mug, "mug"));
  settle();
  static_cast<void>(collector_->followCatalogue());
  lookAgain(mapWith(mug_, 0.2), {});
  EXPECT_EQ(framesOfViews(mug).size(), 1U);
}

TEST_F(SecondLook, WhatAPersonMadeAnObjectStaysOne) {
  collector_->requests().request(mug_.region, "");
  ASSERT_EQ(look({mug_}).added.size(), 1U);
  lookAgain(mapWith(mug_, 0.2), {});
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(SecondLook, FindsWhatWasNotClearWhileTheScanRan) {
  lookAgain(mapWith(mug_, 1), {mug_, box_});
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(SecondLook, TwoOfAKindStayTwoHoweverFarApartTheyAreSeen) {
  const ObjectId mug = study({mug_}).added.at(0).id;
  for (int i = 0; i < 200; ++i) static_cast<void>(look({}));
  const Thing other{mug_.seed, 2, RegionId{77}};
  lookAgain(mapWith(mug_, 1), {other});
  EXPECT_EQ(objects().size(), 2U) << "while a scan looks again nothing is carried about";
  EXPECT_NE(collector_->objects().idOf(other.region), mug);
}

}  // namespace
}  // namespace scantrove
