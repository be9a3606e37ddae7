#include "core/collection/object_tracks.h"

#include <gmock/gmock.h>

#include <array>

#include "tests/pipeline/collection/parts_fixture.h"

namespace scantrove {
namespace {

using test::TableItem;
using testing::ElementsAre;
using testing::IsEmpty;

class ObjectTracksTest : public test::PartsFixture {
 protected:
  /// A later frame, taken in front of the item; all depth is at `z_m`.
  void checkPlaceOf(const TableItem& item, float z_m) {
    const Eigen::Isometry3d T_world_camera(Eigen::Translation3d(item.centroid().x(), 0, 0));
    const Intrinsics K{160, 160, 159.5F, 119.5F, 320, 240};
    tracks_->checkPlaces({K, T_world_camera, cv::Mat(240, 320, CV_32FC1, cv::Scalar(z_m))}, kDepthNoise_m,
                         kLater);
  }
  static constexpr int kLater = 100;
};

TEST_F(ObjectTracksTest, ObjectIsMissing_WhenItsPlaceWasSeenEmptySeveralTimes) {
  const ObjectId mug = add(mug_);
  for (int i = 0; i < ObjectTrack::kFramesEmpty - 1; ++i) checkPlaceOf(mug_, 1.2F);
  EXPECT_THAT(tracks_->missing(), IsEmpty());
  checkPlaceOf(mug_, 1.2F);
  EXPECT_THAT(tracks_->missing(), ElementsAre(mug));
  EXPECT_TRUE(tracks_->hasMoved(mug));
}

TEST_F(ObjectTracksTest, ObjectIsNotMissing_WhenItIsHiddenOrSeenOrUnmeasured) {
  static_cast<void>(add(mug_));
  for (const float z_m : {0.3F, 1.01F, 0.0F}) {
    for (int i = 0; i < 5; ++i) checkPlaceOf(mug_, z_m);
    EXPECT_THAT(tracks_->missing(), IsEmpty()) << z_m;
  }
}

TEST_F(ObjectTracksTest, ObjectHasMoved_WhenItIsObservedElsewhereUnderAnotherRegion) {
  const ObjectId mug = add(mug_);
  EXPECT_FALSE(tracks_->hasMoved(mug));
  tracks_->observe(mug, TableItem{mug_.seed, 2, RegionId{77}}.candidate(), kLater);
  EXPECT_TRUE(tracks_->hasMoved(mug));
  EXPECT_EQ(tracks_->objectOf(RegionId{77}), mug);
}

TEST_F(ObjectTracksTest, NearestObjectIsNotFound_WhenItWasObservedSince) {
  const ObjectId mug = add(mug_);
  const auto any = [](ObjectId) { return true; };
  const Candidate here = TableItem{5, mug_.place, RegionId{77}}.candidate();
  EXPECT_EQ(tracks_->nearest(here, kLater, any), mug);
  EXPECT_FALSE(tracks_->nearest(here, kLater, [](ObjectId) { return false; }));
  tracks_->keepAlive(mug, kLater);
  EXPECT_FALSE(tracks_->nearest(here, kLater, any));
}

TEST_F(ObjectTracksTest, ObjectIsNotAtAPlace_WhenItsSizeDiffers) {
  const ObjectId mug = add(mug_);
  Candidate candidate = mug_.candidate();
  EXPECT_TRUE(tracks_->isAt(mug, candidate));
  candidate.size_m *= 2;
  EXPECT_FALSE(tracks_->isAt(mug, candidate));
}

TEST_F(ObjectTracksTest, ObjectIsNone_WhenRegionsBelongToSeveral) {
  const ObjectId mug = add(mug_), box = add(box_);
  EXPECT_EQ(tracks_->objectOf(RegionSet{mug_.region, RegionId{77}}), mug);
  EXPECT_FALSE(tracks_->objectOf(RegionSet{mug_.region, box_.region}));
  EXPECT_FALSE(tracks_->areOneObject({mug_.region, box_.region}));
  catalogue_->merge(mug, box);
  EXPECT_TRUE(tracks_->areOneObject({mug_.region, box_.region}));
}

TEST_F(ObjectTracksTest, JoinReturnsBothObjects_WhenTheyDiffer) {
  const ObjectId mug = add(mug_), box = add(box_);
  EXPECT_EQ(tracks_->joinRegions(RegionId{77}, box_.region), std::pair(ObjectId{}, ObjectId{}))
      << "the other region was no object";
  EXPECT_EQ(tracks_->objectOf(RegionId{77}), box);
  EXPECT_EQ(tracks_->joinRegions(mug_.region, RegionId{77}), std::pair(mug, box));
  EXPECT_EQ(tracks_->objectOf(mug_.region), mug);
}

TEST_F(ObjectTracksTest, RegionKeepsADeletedObject_ThatExistsNoMore) {
  const ObjectId mug = add(mug_);
  store();
  ASSERT_TRUE(person_->remove(std::array{idOf(mug)}));
  store();
  EXPECT_EQ(tracks_->objectOf(mug_.region), mug);
  EXPECT_FALSE(tracks_->existingObjectOf(mug_.region));
}

TEST_F(ObjectTracksTest, ObjectIsInViewBesideRegions_WhenAnotherOfItsRegionsIsInView) {
  const ObjectId mug = add(mug_);
  tracks_->setRegionsInView({mug_.region});
  EXPECT_TRUE(tracks_->isInViewBeside(mug, {RegionId{77}}));
  EXPECT_FALSE(tracks_->isInViewBeside(mug, {mug_.region}));
}

}  // namespace
}  // namespace scantrove
