#include "core/discovery/reach_history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numbers>

#include "core/discovery/rule_based_finder.h"
#include "tests/unit/discovery/painted_scene.h"

namespace scantrove {
namespace {

using test::PaintedScene;

constexpr RegionId kSign{7};
constexpr float kDepth_m = 0.3F;
constexpr int kWidth_px = 180, kHeight_px = 60;  // at that depth: 36 x 12 cm; the image has 160 x 120
const cv::Rect kVisible(0, 0, 160, 120);

/// A sign that is wider than the image, before a wall. The camera has moved along it so that it begins in
/// column `left_px`, which may lie outside.
PaintedScene signFrom(int left_px, int top_px = 30, int width_px = kWidth_px, double turned_rad = 0) {
  PaintedScene scene;
  const double meters_per_px = static_cast<double>(kDepth_m) / 150;
  scene.view.T_world_camera = Eigen::AngleAxisd(turned_rad, Eigen::Vector3d::UnitZ()) *
                              Eigen::Translation3d(-meters_per_px * left_px, -meters_per_px * top_px, 0);
  scene.view.regions.assign(scene.view.regions.size(), RegionId{});
  scene.paint(1, {0, 0, 160, 120}, [](int, int) { return 2.0F; });
  const cv::Rect box = cv::Rect(left_px, top_px, width_px, kHeight_px) & cv::Rect(0, 0, 160, 120);
  scene.paint(kSign.value, box, [](int, int) { return kDepth_m; });
  return scene;
}

void addFrames(ReachHistory& history, const PaintedScene& scene, int frames) {
  for (int i = 0; i < frames; ++i) history.add(scene.input(), kVisible, 1);
}

TEST(ReachHistory, IsSeenToItsEnds_WhenDifferentFramesShowThem) {
  ReachHistory history;
  addFrames(history, signFrom(10), 20);
  EXPECT_FALSE(history.isSeenToItsEnds(kSign, 5)) << "its right end is not seen yet";
  addFrames(history, signFrom(-30), 5);
  EXPECT_FALSE(history.isSeenToItsEnds(kSign, 5)) << "it has just grown";
  EXPECT_TRUE(history.isSeenToItsEnds(kSign, 4));
  addFrames(history, signFrom(-30), 1);
  EXPECT_TRUE(history.isSeenToItsEnds(kSign, 5));
  // Ends are measured in every second pixel.
  const Eigen::Vector3f size = history.sizeOf(kSign);
  EXPECT_NEAR(size.x(), 0.36, 0.006);
  EXPECT_NEAR(size.y(), 0.12, 0.006);
  EXPECT_NEAR(size.z(), 0, 1e-6);
}

/// Size of the sign after frames of both ends, longest side first.
Eigen::Vector3f sizeOfRotated(double turned_rad, const Eigen::Matrix3f& axes) {
  ReachHistory history;
  addFrames(history, signFrom(10, 30, kWidth_px, turned_rad), 5);
  addFrames(history, signFrom(-30, 30, kWidth_px, turned_rad), 5);
  Eigen::Vector3f size = history.sizeOf(kSign, axes);
  std::sort(size.begin(), size.end(), std::greater<>());
  return size;
}

TEST(ReachHistory, MeasuresAlongTheSides_WhenTheyLieAcrossTheAxesOfTheWorld) {
  const Eigen::Vector3f size = sizeOfRotated(std::numbers::pi / 4, Eigen::Matrix3f::Identity());
  EXPECT_NEAR(size.x(), 0.36, 0.01);
  EXPECT_NEAR(size.y(), 0.12, 0.01);
  EXPECT_NEAR(size.z(), 0, 0.01);
}

TEST(ReachHistory, MeasuresAlongTheSides_WhenTheyLieAsTheLastFrameSuggests) {
  for (const double turned_rad : {0.2, 0.4, 1.1}) {
    SCOPED_TRACE(turned_rad);
    const Eigen::Matrix3f axes =
        Eigen::AngleAxisd(turned_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix().cast<float>();
    const Eigen::Vector3f size = sizeOfRotated(turned_rad, axes);
    EXPECT_NEAR(size.x(), 0.36, 0.015);
    EXPECT_NEAR(size.y(), 0.12, 0.015);
    EXPECT_NEAR(size.z(), 0, 0.015);
  }
}

TEST(ReachHistory, IsNotSeenToItsEnds_WhenOneIsAlwaysOutside) {
  ReachHistory history;
  addFrames(history, signFrom(10, 70), 10);  // its lower edge lies below the image
  addFrames(history, signFrom(-30, 70), 20);
  EXPECT_FALSE(history.isSeenToItsEnds(kSign, 5));
}

TEST(ReachHistory, IsNotSeenToItsEnds_WhenOneIsOnTheBorder) {
  ReachHistory history;
  addFrames(history, signFrom(0), 10);
  addFrames(history, signFrom(-30), 10);
  EXPECT_FALSE(history.isSeenToItsEnds(kSign, 5)) << "a region that ends in column 0 may continue";
}

TEST(ReachHistory, ShownPartIsThatOfTheLastFrame) {
  ReachHistory history;
  addFrames(history, signFrom(10), 1);
  EXPECT_NEAR(history.shownPart(kSign), 1, 1e-6) << "all known points are in view";
  addFrames(history, signFrom(-30), 1);
  addFrames(history, signFrom(10), 1);
  EXPECT_NEAR(history.shownPart(kSign), 150.0 / 180, 0.03);
  history.add(PaintedScene().input(), kVisible, 1);
  EXPECT_EQ(history.shownPart(kSign), 0);
}

TEST(ReachHistory, MeasuresLargeRegionsAgain_AfterAWhile) {
  ReachHistory history;
  for (int i = 0; i < 70; ++i) history.add(signFrom(10, 30, 60).input(), kVisible, 0.1F);  // 12 cm
  EXPECT_FALSE(history.isSeenToItsEnds(kSign, 5));
  EXPECT_EQ(history.sizeOf(kSign).norm(), 0);
  for (int i = 0; i < 130; ++i) history.add(signFrom(10, 30, 60).input(), kVisible, 0.5F);
  EXPECT_TRUE(history.isSeenToItsEnds(kSign, 5)) << "it is measured again";
  EXPECT_NEAR(history.sizeOf(kSign).x(), 0.12, 0.006);
}

TEST(ReachHistory, DropsRegions_WhenChangedOrUnseenForLong) {
  ReachHistory history;
  addFrames(history, signFrom(10), 10);
  history.forget(kSign);
  addFrames(history, signFrom(-30), 10);
  EXPECT_FALSE(history.isSeenToItsEnds(kSign, 5)) << "earlier frames saw its left end";
  for (int i = 0; i <= ReachHistory::kMemory; ++i) history.add(PaintedScene().input(), kVisible, 10);
  EXPECT_EQ(history.regionCount(), 1U) << "only the wall";
}

// No frame shows the whole sign, but all frames together do: the rules accept it like any other object.
TEST(ReachHistory, RegionIsACandidate_OnceAllFramesTogetherShowItsEnds) {
  DiscoveryParams params;
  params.persistent_frames = 5;
  params.min_points = 1600;  // at 640x480; 100 at 160x120
  const auto finder = makeRuleBasedFinder(params);
  const auto find = [&](const PaintedScene& scene, int frames) {
    std::vector<Candidate> found;
    for (int i = 0; i < frames; ++i) found = finder->find(scene.input());
    return found;
  };
  EXPECT_THAT(find(signFrom(10), 20), testing::IsEmpty());
  const std::vector<Candidate> found = find(signFrom(-30), 8);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].regions, RegionSet{kSign});
  EXPECT_NEAR(found[0].size_m[0], 0.36, 0.006) << "the size of the complete sign";
  EXPECT_EQ(found[0].box_px, cv::Rect(0, 30, 150, 60)) << "the box of the visible part";
  EXPECT_GT(found[0].outline, 0.95) << "the image border does not count as outline";
  EXPECT_THAT(find(signFrom(-100), 8), testing::IsEmpty()) << "44 % of it are too little for a view";
}

}  // namespace
}  // namespace scantrove
