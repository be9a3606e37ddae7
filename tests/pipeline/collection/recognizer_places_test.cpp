// Objects that ObjectCollector recognises because earlier scans saw the same place.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/pipeline/collection/object_collector_fixture.h"

namespace scantrove {
namespace {

using test::TableItem;

/// Four objects in a room, all known from another scan.
class RecognizerPlacesTest : public test::ObjectCollectorFixture {
 protected:
  struct Placed {
    TableItem item;
    Eigen::Vector3f at;
  };

  void SetUp() override {
    ObjectCollectorFixture::SetUp();
    static_cast<void>(studyPlaced(three_));
    jar_id_ = studyPlaced({jar_}).added.at(0).id;
    beginScan();
  }
  /// Enough frames to decide about each item, in a world transformed by `T`.
  FrameObjects studyPlaced(const std::vector<Placed>& placed,
                           const Eigen::Isometry3f& T = Eigen::Isometry3f::Identity()) {
    FrameObjects all;
    for (int i = 0; i < 40; ++i) {
      std::vector<Candidate> candidates;
      std::vector<TableItem> items;
      for (const Placed& one : placed) {
        items.push_back(one.item);
        candidates.push_back(one.item.candidate());
        candidates.back().centroid_world = T * one.at;
      }
      FrameObjects objects = showCandidates(candidates, items);
      std::ranges::move(objects.added, std::back_inserter(all.added));
      std::ranges::move(objects.recognized, std::back_inserter(all.recognized));
    }
    return all;
  }
  /// The jar in other light from another side: too different to be recognised by that alone.
  [[nodiscard]] Placed jarInOtherLight() const {
    Placed jar = jar_;
    jar.item.change = kOtherLight;
    return jar;
  }

  static constexpr double kOtherLight = 0.6;
  const std::vector<Placed> three_{
      {mug_, {0, 0, 1}}, {box_, {0.6F, 0.1F, 1.2F}}, {cup_, {-0.3F, 0.4F, 1.6F}}};
  const Placed jar_{{4, 1, RegionId{14}}, {0.9F, -0.5F, 1.4F}};
  const Eigen::Isometry3f T_now_then_ =
      Eigen::Translation3f(0.5F, -1, 0.3F) * Eigen::AngleAxisf(0.7F, Eigen::Vector3f(1, 2, -1).normalized());
  ObjectId jar_id_;
};

TEST_F(RecognizerPlacesTest, LowSimilarityIsEnough_AtTheExpectedPlace) {
  EXPECT_EQ(studyPlaced(three_, T_now_then_).recognized.size(), 3U);
  const FrameObjects found = studyPlaced({jarInOtherLight()}, T_now_then_);
  EXPECT_TRUE(found.added.empty());
  ASSERT_EQ(found.recognized.size(), 1U);
  EXPECT_EQ(found.recognized[0].id, jar_id_);
}

TEST_F(RecognizerPlacesTest, AddsANewObject_AtAnotherPlace) {
  static_cast<void>(studyPlaced(three_, T_now_then_));
  Placed elsewhere = jarInOtherLight();
  elsewhere.at.x() += 0.4F;
  EXPECT_EQ(studyPlaced({elsewhere}, T_now_then_).added.size(), 1U);
}

TEST_F(RecognizerPlacesTest, AddsANewObject_WhenTwoObjectsDoNotFixThePlace) {
  static_cast<void>(studyPlaced({three_[0], three_[1]}, T_now_then_));
  EXPECT_EQ(studyPlaced({jarInOtherLight()}, T_now_then_).added.size(), 1U)
      << "two objects do not fix a place";
}

TEST_F(RecognizerPlacesTest, AddsANewObject_WhenAppearanceOrSizeDiffers) {
  static_cast<void>(studyPlaced(three_, T_now_then_));
  Placed other = jar_;
  other.item.seed = 6;
  EXPECT_EQ(studyPlaced({other}, T_now_then_).added.size(), 1U);
  Placed larger = jarInOtherLight();
  larger.item.region = RegionId{15};
  Candidate candidate = larger.item.candidate();
  candidate.centroid_world = T_now_then_ * larger.at;
  candidate.size_m *= 1.5F;
  for (int i = 0; i < 40; ++i) static_cast<void>(showCandidates({candidate}, {larger.item}));
  EXPECT_NE(collector_->objects().idOf(larger.item.region), jar_id_);
}

TEST_F(RecognizerPlacesTest, RecognizesByPlace_WhenThePlaceIsKnownOnlyAtTheEnd) {
  const ObjectId taken_for_new = studyPlaced({jarInOtherLight()}, T_now_then_).added.at(0).id;
  static_cast<void>(studyPlaced(three_, T_now_then_));
  collector_->beginRefinement();
  collector_->settleComplete({}, [](RegionId) { return false; });
  const FrameObjects found = studyPlaced({jarInOtherLight()}, T_now_then_);
  ASSERT_EQ(found.recognized.size(), 1U) << "the recognition is reported";
  EXPECT_EQ(found.recognized[0].id, jar_id_);
  collector_->endRefinement();
  settle();
  static_cast<void>(collector_->applyCatalogueChanges());
  EXPECT_EQ(collector_->objects().idOf(jar_.item.region), jar_id_);
  EXPECT_EQ(*person_->mergeRoot(taken_for_new), jar_id_);
  EXPECT_EQ(objects().size(), 4U);
}

}  // namespace
}  // namespace scantrove
