#include "ui/models/next_steps.h"

#include <gmock/gmock.h>

#include "ui/models/key_frame_reviews.h"

namespace scantrove::test {
namespace {

using testing::ElementsAre;
using Kind = NextStep::Kind;

TEST(NextSteps, NameFirst_ThenCheck_ThenExport) {
  const WorkLeft work{.unnamed_objects = 12, .key_frames = {.open = 9, .checked = 4, .left_out = 1}};
  EXPECT_THAT(nextStepsOf(work), ElementsAre(NextStep{Kind::name, 12, true}, NextStep{Kind::check, 9, false},
                                             NextStep{Kind::export_data, 0, false}));
}

TEST(NextSteps, AreOnlyTheExport_WhenAllIsDone) {
  const WorkLeft work{.unnamed_objects = 0, .key_frames = {.open = 0, .checked = 4, .left_out = 1}};
  EXPECT_THAT(nextStepsOf(work), ElementsAre(NextStep{Kind::export_data, 0, true}));
}

TEST(NextSteps, SayWhatIsLeft) {
  EXPECT_EQ(textOf({Kind::name, 12}), QStringLiteral("Name 12 found objects"));
  EXPECT_EQ(textOf({Kind::name, 1}), QStringLiteral("Name 1 found object"));
  EXPECT_EQ(textOf({Kind::check, 9}), QStringLiteral("Check 9 key frames"));
  EXPECT_EQ(textOf({Kind::export_data, 0}), QStringLiteral("Export data set"));
}

RegionInfo foundRegion(std::uint32_t region, std::uint32_t object, const std::string& name) {
  RegionInfo info;
  info.region = RegionId{region};
  info.voxels = 100;
  info.object = ObjectId{object};
  RegionLabel label;
  label.object = info.object;
  label.name = name.empty() ? "Obj_" + std::to_string(object) : name;
  label.is_named = !name.empty();
  label.is_object = object > 0;
  info.label = label;
  return info;
}

TEST(UnnamedObjects, CountEachObjectOnce) {
  const RegionInfos regions{foundRegion(1, 4, ""), foundRegion(2, 4, ""), foundRegion(3, 5, ""),
                            foundRegion(4, 6, "red cup"), foundRegion(5, 0, "")};
  EXPECT_EQ(countUnnamed(regions), 2);
}

TEST(UnnamedObjects, AreNoBackground) {
  RegionInfos regions{foundRegion(1, 4, ""), foundRegion(2, 5, ""), foundRegion(3, 6, "")};
  regions[0].label->background = true;
  regions[1].label->rejected = true;
  EXPECT_EQ(countUnnamed(regions), 1);
}

ScanSnapshot withReviews(std::initializer_list<ReviewState> states) {
  ScanSnapshot snapshot;
  std::vector<FrameReview> reviews;
  for (const ReviewState state : states) {
    const auto number = static_cast<int>(reviews.size());
    reviews.push_back({number, 10 * number, state});
  }
  snapshot.reviews = std::make_shared<const std::vector<FrameReview>>(std::move(reviews));
  return snapshot;
}

TEST(KeyFrameReviews, GoOnAtTheOtherEnd) {
  using enum ReviewState;
  KeyFrameReviews reviews;
  reviews.update(withReviews({open, checked, left_out, open, checked}));
  EXPECT_EQ(reviews.next(0, 1, ReviewFilter::open), 3);
  EXPECT_EQ(reviews.next(3, 1, ReviewFilter::open), 0);
  EXPECT_EQ(reviews.next(0, -1, ReviewFilter::open), 3);
  EXPECT_EQ(reviews.next(3, -1, ReviewFilter::checked), 1);
  EXPECT_EQ(reviews.next(2, 1, ReviewFilter::all), 3);
  EXPECT_EQ(reviews.counts(), (ReviewCounts{.open = 2, .checked = 2, .left_out = 1}));
}

TEST(KeyFrameReviews, HaveNoOther_WhenNonePasses) {
  KeyFrameReviews reviews;
  EXPECT_EQ(reviews.next(0, 1, ReviewFilter::all), -1);
  reviews.update(withReviews({ReviewState::open, ReviewState::checked}));
  EXPECT_EQ(reviews.next(0, 1, ReviewFilter::open), -1) << "the shown one is no other";
}

TEST(KeyFrameReviews, ShowAChangeAtOnce) {
  KeyFrameReviews reviews;
  reviews.update(withReviews({ReviewState::open, ReviewState::open}));
  reviews.set(1, ReviewState::left_out);
  reviews.set(7, ReviewState::left_out);
  EXPECT_EQ(reviews.counts(), (ReviewCounts{.open = 1, .checked = 0, .left_out = 1}));
}

}  // namespace
}  // namespace scantrove::test
