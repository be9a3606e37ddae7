#include "core/evaluation/catalogue_metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace scantrove {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using enum CatalogueVerdict;

/// 20 x 10: a table (1), on it a mug (2) of 4 x 5 = 20 pixels at (2, 2), and touching it a bowl (3) of 5 x 5
/// at (6, 2). The last two columns are not annotated.
cv::Mat1i scene() {
  cv::Mat1i truth(10, 20, 1);
  truth(cv::Rect(2, 2, 4, 5)) = 2;
  truth(cv::Rect(6, 2, 5, 5)) = 3;
  truth(cv::Rect(18, 0, 2, 10)) = 0;
  return truth;
}

const std::set<int> kObjects{2, 3};

cv::Mat full(int width, int height) { return {height, width, CV_8UC1, cv::Scalar(255)}; }

ViewJudgment judge(const cv::Rect& box) {
  return judgeView(full(box.width, box.height), box, scene(), kObjects);
}

TEST(JudgeView, VerdictFollowsTheOverlap) {
  // 4 x 4 of the mug's 20 pixels: IoU 0.8. 4 x 3: exactly 0.6, not above it.
  EXPECT_EQ(judge({2, 2, 4, 4}).verdict, complete);
  EXPECT_THAT(judge({2, 2, 4, 4}).instances, ElementsAre(2));
  EXPECT_EQ(judge({2, 2, 4, 3}).verdict, part);
  EXPECT_THAT(judge({2, 2, 4, 3}).instances, ElementsAre(2));
  // Mug and bowl: 25 of 45 pixels are the bowl, IoU 0.56.
  EXPECT_EQ(judge({2, 2, 9, 5}).verdict, merger);
  EXPECT_THAT(judge({2, 2, 9, 5}).instances, ElementsAre(3, 2));
  // One row of the mug and three rows of the table.
  EXPECT_EQ(judge({2, 6, 4, 4}).verdict, background);
  EXPECT_THAT(judge({2, 6, 4, 4}).instances, ElementsAre(1, 2));
  // Two thirds are mug, one third is table: neither part nor background.
  EXPECT_EQ(judge({2, 5, 4, 3}).verdict, merger);
  EXPECT_THAT(judge({2, 5, 4, 3}).instances, ElementsAre(2, 1));
}

TEST(JudgeView, IsBackground_WhenTheMaskIsNotAnnotated) {
  EXPECT_EQ(judge({18, 0, 2, 10}).verdict, background);
  EXPECT_THAT(judge({18, 0, 2, 10}).instances, IsEmpty());
  EXPECT_EQ(judgeView({}, {}, scene(), kObjects).verdict, background);
}

TEST(JudgeView, ScalesTheMaskToItsBox) {
  // A mask at twice the resolution. The box shows mug and bowl; only the left half, the mug, is set.
  cv::Mat mask(10, 16, CV_8UC1, cv::Scalar(0));
  mask.colRange(0, 8) = 255;
  EXPECT_EQ(judgeView(mask, {2, 2, 8, 5}, scene(), kObjects).verdict, complete);
  // Half of the box lies outside the image.
  EXPECT_EQ(judgeView(full(4, 4), {-2, 2, 4, 4}, scene(), kObjects).verdict, background);
}

TEST(JudgeEntry, IsComplete_WhenFourOfFiveViewsAre) {
  const ViewJudgment mug{complete, {2}};
  const ViewJudgment half{part, {2}};
  const ViewJudgment both{merger, {3, 2}};
  const std::vector<ViewJudgment> good{mug, half, mug, mug, mug};
  EXPECT_EQ(judgeEntry(good).verdict, complete);
  EXPECT_THAT(judgeEntry(good).instances, ElementsAre(2));
  EXPECT_EQ(judgeEntry(good).complete_views, 4);
  const std::vector<ViewJudgment> poor{mug, mug, half, both, both, both};
  EXPECT_EQ(judgeEntry(poor).verdict, merger);
  EXPECT_THAT(judgeEntry(poor).instances, ElementsAre(3, 2));
  EXPECT_EQ(judgeEntry(poor).views, 6);
  EXPECT_EQ(judgeEntry(poor).complete_views, 2);
}

TEST(JudgeEntry, IsAMerger_WhenViewsShowTwoCompleteObjects) {
  const std::vector<ViewJudgment> views{{complete, {2}}, {complete, {3}}};
  EXPECT_EQ(judgeEntry(views).verdict, merger);
  EXPECT_THAT(judgeEntry(views).instances, ElementsAre(2, 3));
  EXPECT_EQ(judgeEntry({}).verdict, background);
}

TEST(ShouldBeFound, IsTrue_FromFiveToSixtyCentimetersInThirtyFrames) {
  EXPECT_TRUE(shouldBeFound({30, 0.05}));
  EXPECT_TRUE(shouldBeFound({300, 0.60}));
  EXPECT_FALSE(shouldBeFound({29, 0.2}));
  EXPECT_FALSE(shouldBeFound({30, 0.049}));
  EXPECT_FALSE(shouldBeFound({30, 0.61}));
  EXPECT_FALSE(shouldBeFound({30, 0}));
}

TEST(CountVisible, CountsFrames_WithFourHundredPixelsAt640x480) {
  cv::Mat1i truth(240, 320, 1);          // a quarter of 640 x 480: 100 pixels
  truth(cv::Rect(0, 0, 10, 10)) = 2;     // 100
  truth(cv::Rect(100, 100, 11, 9)) = 3;  // 99
  std::map<int, TrueObject> objects{{2, {}}, {3, {}}, {4, {}}};
  countVisible(truth, objects);
  countVisible(truth, objects);
  EXPECT_EQ(objects[2].frames, 2);
  EXPECT_EQ(objects[2].entire_frames, 0) << "the border may cut it";
  EXPECT_EQ(objects[3].frames, 0);
  EXPECT_EQ(objects[4].frames, 0);
  EXPECT_EQ(objects.size(), 3U) << "the table is not added";
}

TEST(CountVisible, CountsEntireFrames_AwayFromAllFourBorders) {
  const std::map<int, cv::Rect> boxes{{2, {100, 100, 12, 12}}, {3, {0, 50, 12, 12}},
                                      {4, {308, 50, 12, 12}},  {5, {150, 0, 12, 12}},
                                      {6, {150, 228, 12, 12}}, {7, {1, 1, 12, 12}}};
  cv::Mat1i truth(240, 320, 1);
  std::map<int, TrueObject> objects;
  for (const auto& [instance, box] : boxes) {
    truth(box) = instance;
    objects[instance] = {};
  }
  countVisible(truth, objects);
  for (const auto& [instance, object] : objects) {
    EXPECT_EQ(object.frames, 1) << instance;
    EXPECT_EQ(object.entire_frames, instance == 2 || instance == 7 ? 1 : 0) << instance;
  }
  EXPECT_TRUE(wasSeenEntirely({40, 0.1, 30}));
  EXPECT_FALSE(wasSeenEntirely({40, 0.1, 29}));
  EXPECT_FALSE(wasSeenEntirely({40, 0.7, 30}));
}

TEST(EvaluateCatalogue, ReturnsKnownPurityAndCompleteness) {
  const std::vector<EntryJudgment> entries{
      {complete, {2}, 5, 5}, {complete, {2}, 1, 1}, {part, {3}, 2, 0}, {background, {1}, 1, 0}};
  // 2, 3 and 6 are expected. 4 is too small, 5 is in too few frames, and 6 is entire in too few frames.
  const std::map<int, TrueObject> objects{
      {2, {100, 0.1, 60}}, {3, {40, 0.3, 30}}, {4, {100, 0.03, 90}}, {5, {10, 0.2, 10}}, {6, {50, 0.3, 2}}};
  const CatalogueMetrics metrics = evaluateCatalogue(entries, objects);
  EXPECT_EQ(metrics.entries, 4);
  EXPECT_EQ(metrics.complete, 2);
  EXPECT_EQ(metrics.purity, 0.5);
  EXPECT_EQ(metrics.expected, 3);
  EXPECT_DOUBLE_EQ(metrics.completeness, 1.0 / 3);
  EXPECT_EQ(metrics.seen_entirely, 2);
  EXPECT_EQ(metrics.completeness_of_entire, 0.5);
  EXPECT_THAT(metrics.missing, ElementsAre(3, 6));
  EXPECT_EQ(metrics.duplicates, 1);
  EXPECT_EQ(evaluateCatalogue({}, {}).purity, 0);
}

}  // namespace
}  // namespace scantrove
