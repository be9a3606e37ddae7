#include "core/collection/view_keeper.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>

#include "tests/pipeline/collection/parts_fixture.h"

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Views are taken at 1 m.
class ViewKeeperTest : public test::PartsFixture {
 protected:
  static constexpr float kBehindView_m = 1.2F;
};

TEST_F(ViewKeeperTest, KeepsView_WhenTheMapShowsItsObject) {
  const ObjectId mug = add(mug_);
  compareWith(mapWith(mug_, 0.8));
  removeOutdated();
  EXPECT_THAT(framesOfViews(idOf(mug)), ElementsAre(0));
}

TEST_F(ViewKeeperTest, KnowsTheCamerasOfItsViews) {
  static_cast<void>(add(mug_));
  EXPECT_THAT(views_->framesOfViews(), ElementsAre(0));
  ASSERT_EQ(views_->camerasOfViews(0).size(), 1U);
  EXPECT_EQ(views_->camerasOfViews(0).front().image_px,
            cv::Size(test::kWorking.width, test::kWorking.height));
  EXPECT_THAT(views_->camerasOfViews(12345), IsEmpty());
}

TEST_F(ViewKeeperTest, ComparesViewsWithMapsOfTheirSizeOnly) {
  static_cast<void>(add(mug_));
  RenderedView larger;
  larger.K = test::kWorking.resizedTo(2 * test::kWorking.width, 2 * test::kWorking.height);
  larger.regions.resize(4 * static_cast<std::size_t>(test::kWorking.pixels()));
  larger.vertices_world.assign(larger.regions.size(), {0, 0, 1, 1});
  compareWith(larger);
  EXPECT_EQ(views_->objectsInValidViews().size(), 1U);
  compareWith(mapWith(mug_, 0.5));
  EXPECT_THAT(views_->objectsInValidViews(), IsEmpty());
}

TEST_F(ViewKeeperTest, ReplacesView_WhenItsRegionHasChanged) {
  const ObjectId mug = add(mug_);
  compareWith(mapWith(mug_, 0.5));
  addView(mug, mug_, mug_.candidate(), 0);  // from the same side
  removeOutdated();
  EXPECT_THAT(framesOfViews(idOf(mug)), ElementsAre(1));
  EXPECT_EQ(catalogue_->record(mug)->views, 1);
}

TEST_F(ViewKeeperTest, RemovesObject_WhenNoViewShowsIt) {
  const ObjectId mug = add(mug_), box = add(box_);
  compareWith(mapWith(box_, 1));
  removeOutdated();
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].id, idOf(box));
  EXPECT_EQ(catalogue_->currentRecord(mug), nullptr);
}

TEST_F(ViewKeeperTest, KeepsView_WhenItsObjectWasRemovedFromTheScene) {
  static_cast<void>(add(mug_));
  compareWith(mapWith(mug_, 0.2, kBehindView_m));
  removeOutdated();
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(ViewKeeperTest, RemovesViewWithSomethingRemoved_WhenAnotherViewShowsTheObjectInPlace) {
  const ObjectId mug = add(mug_);
  compareWith(mapWith(mug_, 0.2, kBehindView_m));
  addView(mug, mug_, mug_.candidate(), 60);
  removeOutdated();
  EXPECT_THAT(framesOfViews(idOf(mug)), ElementsAre(1));
}

TEST_F(ViewKeeperTest, RemovesViewsOfReplacedObject_EvenIfItWasRemovedLater) {
  const ObjectId with_more = add(mug_);
  tracks_->unbind({mug_.region}, with_more);
  const ObjectId mug = add(mug_);
  identities_->replace(with_more, mug);
  compareWith(mapWith(mug_, 0.2, kBehindView_m));
  removeOutdated();
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].id, idOf(mug));
}

TEST_F(ViewKeeperTest, RemovesReplacedObject_WhenAUserDeletedItsReplacement) {
  const ObjectId part = add(mug_);
  tracks_->unbind({mug_.region}, part);
  const ObjectId larger = add(mug_, 60);
  identities_->replace(part, larger);
  store();
  ASSERT_TRUE(person_->remove(std::array{idOf(larger)}));
  store();
  compareWith(mapWith(mug_, 1));
  removeOutdated();
  EXPECT_THAT(objects(), IsEmpty());
}

TEST_F(ViewKeeperTest, RemovesView_WhenItShowsAPartOfTheObject) {
  const ObjectId mug = add(mug_);
  const RegionId rest{14};
  RenderedView map = mapWith(mug_, 1);
  std::fill(map.regions.end() - 30 * map.K.width, map.regions.end(), rest);
  tracks_->bind({rest}, mug);
  compareWith(map);
  removeOutdated();
  EXPECT_THAT(objects(), IsEmpty());
}

TEST_F(ViewKeeperTest, ReplacesViewOfOneRegion_WhenTheCompleteSetIsLarger) {
  const ObjectId mug = add(mug_);
  const RegionId handle{77};
  RenderedView map = mapWith(mug_, 1);
  // Beside the mug and nearly as large: the mug alone is still slightly more than half of both.
  const cv::Rect box_px = mug_.candidate().box_px;
  for (int v = box_px.y; v < box_px.br().y; ++v) {
    const auto beside = map.regions.begin() + v * map.K.width + box_px.br().x;
    std::fill_n(beside, 9 * box_px.width / 10, handle);
  }
  Candidate both = mug_.candidate();
  both.regions.add(handle);
  identities_->settle(std::array{CompleteSet{both.regions, 3}});
  compareWith(map);
  addView(mug, mug_, both, 0);  // from the same side
  removeOutdated();
  EXPECT_THAT(framesOfViews(idOf(mug)), ElementsAre(1));
}

TEST_F(ViewKeeperTest, KeepsViews_WhenAUserNamedTheObject) {
  const ObjectId mug = add(mug_);
  store();
  ASSERT_TRUE(person_->rename(idOf(mug), "mug"));
  store();
  compareWith(mapWith(mug_, 0.2));
  removeOutdated();
  EXPECT_THAT(framesOfViews(idOf(mug)), ElementsAre(0));
}

TEST_F(ViewKeeperTest, KeepsViews_WhenAUserRequestedTheObject) {
  requests_->request(mug_.region, {});
  const ObjectId mug = add(mug_);
  requests_->complete(mug_.candidate(), mug, UserRequests::MadeFor::request);
  compareWith(mapWith(mug_, 0.2));
  removeOutdated();
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(ViewKeeperTest, RemovesObjectOfUnlikelyRegions_UnlessAUserNamedIt) {
  static_cast<void>(add(mug_));
  const ObjectId box = add(box_);
  store();
  ASSERT_TRUE(person_->rename(idOf(box), "my box"));
  store();
  views_->dropUnlikely([](RegionId) { return true; });
  removeOutdated();
  ASSERT_EQ(objects().size(), 1U);
  EXPECT_EQ(objects()[0].id, idOf(box));
}

TEST_F(ViewKeeperTest, KeepsObjectOfUnlikelyRegions_WhenAUserMergedOrRestoredIt) {
  const ObjectId mug = add(mug_), box = add(box_), cup = add(cup_);
  store();
  ASSERT_TRUE(person_->merge(std::array{idOf(mug), idOf(box)}));
  ASSERT_TRUE(person_->remove(std::array{idOf(cup)}));
  ASSERT_TRUE(person_->restore(std::array{idOf(cup)}));
  store();
  views_->dropUnlikely([](RegionId) { return true; });
  removeOutdated();
  EXPECT_EQ(objects().size(), 2U);
}

TEST_F(ViewKeeperTest, KeepsObject_WhenItsRegionsWereNotRated) {
  static_cast<void>(add(mug_));
  views_->dropUnlikely([this](RegionId region) { return region == box_.region; });
  removeOutdated();
  EXPECT_EQ(objects().size(), 1U);
}

TEST_F(ViewKeeperTest, StoresView_OnlyFromNewDirections) {
  const ObjectId mug = add(mug_);
  addView(mug, mug_, mug_.candidate(), 10);
  EXPECT_EQ(views_->all().size(), 1U);
  addView(mug, mug_, mug_.candidate(), 25);
  EXPECT_EQ(views_->all().size(), 2U);
}

TEST_F(ViewKeeperTest, MatchesAnotherSize_WhenSeenFromAnotherSide) {
  const ObjectId mug = add(mug_);
  Candidate with_another_face = mug_.candidate();
  with_another_face.size_m *= 1.35F;
  const ObjectRecord& known = *catalogue_->record(mug);
  EXPECT_FALSE(views_->matchesSize(known, with_another_face, takeFrame({mug_}, 21).observed()));
  EXPECT_TRUE(views_->matchesSize(known, with_another_face, takeFrame({mug_}, 45).observed()));
  EXPECT_FALSE(views_->contradictsSize(known, with_another_face));
}

}  // namespace
}  // namespace scantrove
