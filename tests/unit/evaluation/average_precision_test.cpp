#include "core/evaluation/average_precision.h"

#include <gtest/gtest.h>

#include <vector>

namespace scantrove {
namespace {

/// Appends `count` points of prediction `predicted` and true instance `truth`.
void addPointsTo(PointInstances& scene, int count, std::uint32_t predicted, std::uint32_t truth) {
  scene.predicted.insert(scene.predicted.end(), static_cast<std::size_t>(count), predicted);
  scene.truth.insert(scene.truth.end(), static_cast<std::size_t>(count), truth);
}

AveragePrecision precisionOf(const PointInstances& scene) { return averagePrecision({&scene, 1}); }

TEST(AveragePrecision, IsOne_WhenPredictionsEqualTheTruth) {
  PointInstances scene;
  addPointsTo(scene, 300, 7, 1);
  addPointsTo(scene, 200, 9, 2);
  const AveragePrecision found = precisionOf(scene);
  EXPECT_DOUBLE_EQ(found.ap.value(), 1);
  EXPECT_DOUBLE_EQ(found.ap50.value(), 1);
  EXPECT_DOUBLE_EQ(found.ap25.value(), 1);
  EXPECT_EQ(found.instances, 2);
  EXPECT_EQ(found.predictions, 2);
}

TEST(AveragePrecision, IsAHalf_WhenOneOfTwoInstancesIsFound) {
  PointInstances scene;
  addPointsTo(scene, 300, 7, 1);
  addPointsTo(scene, 200, 0, 2);
  EXPECT_DOUBLE_EQ(precisionOf(scene).ap.value(), 0.5);
}

TEST(AveragePrecision, IsZero_WhenNothingIsPredicted) {
  PointInstances scene;
  addPointsTo(scene, 300, 0, 1);
  EXPECT_DOUBLE_EQ(precisionOf(scene).ap.value(), 0);
  EXPECT_DOUBLE_EQ(precisionOf(scene).ap25.value(), 0);
}

TEST(AveragePrecision, HasNoValue_WithoutTrueInstances) {
  PointInstances scene;
  addPointsTo(scene, 300, 7, 0);
  EXPECT_FALSE(precisionOf(scene).ap.has_value());
  EXPECT_FALSE(averagePrecision({}).ap25.has_value());
}

// One prediction covers instances of 300 and 100 points: IoU 0.75 and 0.25, neither above that threshold. It
// is true for the first one at 0.50 to 0.70, five of ten thresholds.
TEST(AveragePrecision, MergedPairFindsTheLargerInstanceOnly) {
  PointInstances scene;
  addPointsTo(scene, 300, 7, 1);
  addPointsTo(scene, 100, 7, 2);
  const AveragePrecision merged = precisionOf(scene);
  EXPECT_DOUBLE_EQ(merged.ap50.value(), 0.5);
  EXPECT_DOUBLE_EQ(merged.ap25.value(), 0.5);
  EXPECT_DOUBLE_EQ(merged.ap.value(), 5 * 0.5 / 9);
}

// The prediction of 300 of 1000 points (IoU 0.3) is false at 0.50. Ranked first, the curve's points (recall,
// precision) are (0, 1), (0, 0), (0.5, 0.5): area 0.25 * 0.5. Ranked last, they are (0, 1), (0.5, 1),
// (0.5, 0.5): area 0.25 * 1 + 0.25 * 1.
TEST(AveragePrecision, FollowsTheOrderOfConfidence) {
  PointInstances scene;
  addPointsTo(scene, 200, 7, 1);
  addPointsTo(scene, 300, 9, 2);
  addPointsTo(scene, 700, 0, 2);
  EXPECT_DOUBLE_EQ(precisionOf(scene).ap50.value(), 0.125) << "larger predictions come first";
  EXPECT_DOUBLE_EQ(precisionOf(scene).ap25.value(), 1);
  scene.confidence = {{7, 0.9}, {9, 0.2}};
  EXPECT_DOUBLE_EQ(precisionOf(scene).ap50.value(), 0.5);
  // Of equal confidence, they are one point of the curve: (0, 1), (0.5, 0.5).
  scene.confidence = {{7, 0.9}, {9, 0.9}};
  EXPECT_DOUBLE_EQ(precisionOf(scene).ap50.value(), 0.25 * 1 + 0.25 * 0.5);
}

// Both halves have IoU 0.4 and 0.6 with one instance. At 0.25 both match and the more confident one is kept.
TEST(AveragePrecision, CountsTheSecondPredictionOfAnInstanceAsFalse) {
  PointInstances scene;
  addPointsTo(scene, 400, 7, 1);
  addPointsTo(scene, 600, 9, 1);
  EXPECT_DOUBLE_EQ(precisionOf(scene).ap25.value(), 1) << "the false one comes last";
  EXPECT_DOUBLE_EQ(precisionOf(scene).ap50.value(), 1);
  scene.confidence = {{7, 0.9}, {9, 0.2}};
  EXPECT_DOUBLE_EQ(precisionOf(scene).ap25.value(), 1);
  EXPECT_DOUBLE_EQ(precisionOf(scene).ap50.value(), 0.25) << "the false one comes first";
}

// Prediction 9 has 60 of 100 points in the void: ignored at 0.50 and 0.55, false from 0.60 on. Ranked first,
// it makes the curve (0, 1), (0, 0), (1, 0.5) with area 0.25. Prediction 7 has IoU 0.8: true up to 0.75.
TEST(AveragePrecision, IgnoresPredictionsThatAreMostlyVoid) {
  PointInstances scene;
  addPointsTo(scene, 160, 7, 1);
  addPointsTo(scene, 40, 9, 1);
  addPointsTo(scene, 60, 9, 0);
  addPointsTo(scene, 5000, 11, 0);
  scene.confidence = {{7, 0.5}, {9, 0.9}};
  const AveragePrecision found = precisionOf(scene);
  EXPECT_DOUBLE_EQ(found.ap50.value(), 1);
  EXPECT_DOUBLE_EQ(found.ap25.value(), 1);
  EXPECT_DOUBLE_EQ(found.ap.value(), (2 * 1 + 4 * 0.25 + 3 * 0) / 9);
  EXPECT_EQ(found.predictions, 3);
}

TEST(AveragePrecision, IgnoresSmallInstancesAndPredictions) {
  PointInstances scene;
  addPointsTo(scene, 300, 7, 1);
  addPointsTo(scene, 99, 9, 2);  // both too small
  // A prediction of 100 points, 60 of them on an instance of 90, the rest void: IoU 0.46.
  addPointsTo(scene, 60, 11, 3);
  addPointsTo(scene, 30, 0, 3);
  addPointsTo(scene, 40, 11, 0);
  scene.confidence = {{11, 1000}};
  const AveragePrecision found = precisionOf(scene);
  EXPECT_EQ(found.instances, 1);
  EXPECT_EQ(found.predictions, 2);
  EXPECT_DOUBLE_EQ(found.ap.value(), 1);
}

TEST(AveragePrecision, RanksPredictionsOfAllScenesTogether) {
  std::vector<PointInstances> scenes(2);
  addPointsTo(scenes[0], 200, 7, 1);
  addPointsTo(scenes[1], 300, 7, 1);
  addPointsTo(scenes[1], 700, 0, 1);
  EXPECT_DOUBLE_EQ(averagePrecision(scenes).ap50.value(), 0.125) << "as two instances of one scene";
  EXPECT_EQ(averagePrecision(scenes).instances, 2);
}

}  // namespace
}  // namespace scantrove
