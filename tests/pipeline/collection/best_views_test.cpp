#include "core/collection/best_views.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "tests/pipeline/collection/parts_fixture.h"

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

class BestViewsTest : public test::PartsFixture {
 protected:
  void SetUp() override {
    PartsFixture::SetUp();
    best_.emplace(*catalogue_, *tracks_, *requests_, *identities_, *views_);
  }
  /// Adds an object that is completely one region.
  ObjectId addComplete(const test::TableItem& item) {
    const ObjectId object = add(item);
    identities_->settle(std::array{CompleteSet{{item.region}, 0}});
    return object;
  }
  /// The next key frame shows the mug from that direction.
  void offer(double degrees, const Candidate& candidate) {
    frames_.push_back(takeFrame({mug_}, degrees));
    best_->offer(candidate, frames_.back().observed());
  }
  void offer(double degrees) { offer(degrees, mug_.candidate()); }
  /// Prints squares on everything, whose edges show blur.
  static void printSquares(cv::Mat& color) {
    constexpr int kSide_px = 10;
    for (int y = 0; y < color.rows; y += 2 * kSide_px) {
      for (int x = 0; x < color.cols; x += 2 * kSide_px)
        cv::rectangle(color, cv::Rect(x, y, kSide_px, kSide_px), cv::Scalar::all(255), cv::FILLED);
    }
  }
  /// Stores the chosen views from the frames that offered them.
  void storeFrom(const std::vector<int>& chosen) {
    for (const int index : chosen) {
      const auto frame = std::ranges::find_if(
          frames_, [index](const test::TestFrame& taken) { return taken.frame.index == index; });
      ASSERT_NE(frame, frames_.end());
      best_->store(mug_.candidate(), frame->observed());
    }
  }
  void finish() {
    best_->finish();
    removeOutdated();
  }

  static constexpr double kApart_deg = 16;
  std::optional<BestViews> best_;
  std::vector<test::TestFrame> frames_;
};

TEST_F(BestViewsTest, GivesEightViews_WhenEightKeyFramesAreFifteenDegreesApart) {
  const ObjectId mug = addComplete(mug_);
  EXPECT_THAT(best_->sets(), ElementsAre(RegionSet{mug_.region}));
  for (int i = 0; i < 8; ++i) offer(kApart_deg * i);
  const std::vector<int> chosen = best_->choose();
  EXPECT_THAT(chosen, SizeIs(7)) << "the stored view is as good as the first";
  storeFrom(chosen);
  finish();
  EXPECT_THAT(framesOfViews(idOf(mug)), SizeIs(8));
  EXPECT_EQ(catalogue_->record(mug)->views, 8);
}

TEST_F(BestViewsTest, ReplacesAWorseView) {
  test::TestFrame blurred = takeFrame({mug_});
  printSquares(blurred.frame.color);
  cv::blur(blurred.frame.color, blurred.frame.color, {9, 9});
  const ObjectId mug = views_->addObject(mug_.candidate(), blurred.observed());
  tracks_->observe(mug, mug_.candidate(), blurred.frame.index);
  identities_->settle(std::array{CompleteSet{{mug_.region}, 0}});
  frames_.push_back(takeFrame({mug_}, 1));
  printSquares(frames_.back().frame.color);
  best_->offer(mug_.candidate(), frames_.back().observed());
  const std::vector<int> chosen = best_->choose();
  EXPECT_THAT(chosen, ElementsAre(1));
  storeFrom(chosen);
  finish();
  EXPECT_THAT(framesOfViews(idOf(mug)), ElementsAre(1));
  EXPECT_EQ(objects().size(), 1U) << "the object keeps its identity";
}

TEST_F(BestViewsTest, PrefersViewsThatAreLessHidden) {
  const ObjectId mug = addComplete(mug_);
  Candidate hidden = mug_.candidate();
  hidden.hidden = 0.35F;
  offer(60, hidden);
  offer(62);
  EXPECT_THAT(best_->choose(), ElementsAre(2));
  hidden.hidden = 0.8F;
  offer(100, hidden);
  EXPECT_THAT(best_->choose(), ElementsAre(2)) << "too much of it is hidden";
  EXPECT_TRUE(mug);
}

TEST_F(BestViewsTest, OnlyAddsViews_WhenAUserNamedTheObject) {
  const ObjectId mug = addComplete(mug_);
  store();
  ASSERT_TRUE(person_->rename(idOf(mug), "mug"));
  store();
  Candidate larger = mug_.candidate();
  larger.mask.setTo(255);
  offer(1, larger);
  offer(60);
  const std::vector<int> chosen = best_->choose();
  EXPECT_THAT(chosen, ElementsAre(2));
  storeFrom(chosen);
  finish();
  EXPECT_THAT(framesOfViews(idOf(mug)), ElementsAre(0, 2));
}

TEST_F(BestViewsTest, KeepsTheMaximumOfViews) {
  DetectionParams params;
  params.max_views = 3;
  views_->setParams(params);
  const ObjectId mug = addComplete(mug_);
  for (int i = 0; i < 8; ++i) offer(kApart_deg * i);
  storeFrom(best_->choose());
  finish();
  EXPECT_THAT(framesOfViews(idOf(mug)), SizeIs(3));
}

TEST_F(BestViewsTest, IgnoresObjectsThatTheImageCutsOff_AndRegionsThatAreNone) {
  static_cast<void>(addComplete(mug_));
  Candidate cut_off = mug_.candidate();
  cut_off.is_cut_off = true;
  offer(60, cut_off);
  offer(90, box_.candidate());
  EXPECT_THAT(best_->choose(), IsEmpty());
}

TEST_F(BestViewsTest, KeepsOldViews_WhenABetterOneWasNotStored) {
  const ObjectId mug = addComplete(mug_);
  Candidate larger = mug_.candidate();
  larger.mask.setTo(255);
  offer(1, larger);
  EXPECT_THAT(best_->choose(), ElementsAre(1));
  finish();  // the frame could not be read again
  EXPECT_THAT(framesOfViews(idOf(mug)), ElementsAre(0));
}

}  // namespace
}  // namespace scantrove
