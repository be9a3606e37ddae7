#include "core/collection/view_choice.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr std::size_t kManyViews = 24;
constexpr ViewQuality kGood{.pixels = 10000, .sharpness = 0.1F, .outline = 0.95F, .hidden = 0.05F};

/// A view from a direction in the horizontal plane.
OfferedView viewFrom(double degrees, const ViewQuality& quality = kGood) {
  const double angle = degrees * std::numbers::pi / 180;
  return {Eigen::Vector3d(std::cos(angle), std::sin(angle), 0).cast<float>(), quality};
}

std::vector<OfferedView> viewsEvery(double degrees, int count) {
  std::vector<OfferedView> views;
  for (int i = 0; i < count; ++i) views.push_back(viewFrom(degrees * i));
  return views;
}

ViewQuality changed(const std::function<void(ViewQuality&)>& change) {
  ViewQuality quality = kGood;
  change(quality);
  return quality;
}

TEST(ChooseViews, TakesEightViews_WhenEightAreFifteenDegreesApart) {
  EXPECT_EQ(chooseViews(viewsEvery(15.01, 8), 0, kManyViews).size(), 8U);
}

TEST(ChooseViews, TakesEightViews_WhenBetterOnesLieBetweenThem) {
  // The best views are between two of the eight and near to both.
  std::vector<OfferedView> views = viewsEvery(15.01, 8);
  for (int i = 0; i < 4; ++i)
    views.push_back(viewFrom(30.02 * i + 7.5, changed([](ViewQuality& q) { q.sharpness = 0.12F; })));
  EXPECT_GE(chooseViews(views, 0, kManyViews).size(), 8U);
}

TEST(ChooseViews, TakesNoMoreThanAllowed) {
  EXPECT_EQ(chooseViews(viewsEvery(15.01, 20), 0, 12).size(), 12U);
  EXPECT_EQ(chooseViews(viewsEvery(15.01, 20), 0, 3).size(), 3U);
  EXPECT_THAT(chooseViews(viewsEvery(15.01, 20), 0, 0), IsEmpty());
}

TEST(ChooseViews, SpreadsViews_WhenThereAreEnough) {
  // 20 directions 15 degrees apart with two views each, 2 degrees apart.
  std::vector<OfferedView> views = viewsEvery(15.01, 20);
  for (int i = 0; i < 20; ++i) views.push_back(viewFrom(15.01 * i + 2));
  EXPECT_EQ(chooseViews(views, 0, kManyViews).size(), 20U);
}

TEST(ChooseViews, TakesNearerViews_WhenFewDirectionsAreSeen) {
  EXPECT_EQ(chooseViews(viewsEvery(5, 10), 0, kManyViews).size(), kEnoughViews);
  EXPECT_EQ(chooseViews(viewsEvery(0, 10), 0, kManyViews).size(), 1U) << "all from one direction";
}

TEST(ChooseViews, PrefersTheBetterOfTwoViewsFromOneDirection) {
  const ViewQuality smaller = changed([](ViewQuality&q) { q.pixels /= 4; }),
                    more_hidden = changed([](ViewQuality&q) { q.hidden = 0.3F; }),
                    less_sharp = changed([](ViewQuality&q) { q.sharpness = 0.05F; }),
                    less_outlined = changed([](ViewQuality&q) { q.outline = 0.7F; });
  for (const ViewQuality& worse : {smaller, more_hidden, less_sharp, less_outlined}) {
    const std::vector<OfferedView> views{viewFrom(0, worse), viewFrom(1)};
    EXPECT_THAT(chooseViews(views, 0, kManyViews), ElementsAre(1));
  }
}

TEST(ChooseViews, LeavesOutHiddenBlurredAndUnclearViews_WhenOthersAreGood) {
  const std::vector<OfferedView> views{
      viewFrom(0), viewFrom(40, changed([](ViewQuality& q) { q.hidden = 0.6F; })),
      viewFrom(80, changed([](ViewQuality& q) { q.sharpness = 0.02F; })),
      viewFrom(120, changed([](ViewQuality& q) { q.outline = 0.4F; })), viewFrom(160)};
  EXPECT_THAT(chooseViews(views, 0, kManyViews), UnorderedElementsAre(0, 4));
}

TEST(ChooseViews, TakesTheBestView_WhenNoneIsGood) {
  const std::vector<OfferedView> views{viewFrom(0, changed([](ViewQuality& q) { q.hidden = 0.7F; })),
                                       viewFrom(60, changed([](ViewQuality& q) { q.hidden = 0.5F; }))};
  EXPECT_THAT(chooseViews(views, 0, kManyViews), ElementsAre(1));
}

TEST(ChooseViews, AddsToKeptViews) {
  const std::vector<OfferedView> views{viewFrom(0, changed([](ViewQuality& q) { q.hidden = 0.7F; })),
                                       viewFrom(2), viewFrom(60)};
  EXPECT_THAT(chooseViews(views, 1, 2), ElementsAre(0, 2)) << "the second is like the kept one";
  EXPECT_THAT(chooseViews({}, 0, kManyViews), IsEmpty());
}

TEST(ChooseViews, AcceptsUnknownSharpnessAndOutline) {
  const std::vector<OfferedView> views{
      viewFrom(0, changed([](ViewQuality& q) { q.sharpness = q.outline = 0; })), viewFrom(60)};
  EXPECT_THAT(chooseViews(views, 0, kManyViews), UnorderedElementsAre(0, 1));
  EXPECT_THAT(chooseViews(std::span(views).first(1), 0, kManyViews), ElementsAre(0));
}

}  // namespace
}  // namespace scantrove
