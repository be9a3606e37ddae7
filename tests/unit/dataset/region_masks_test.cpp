#include "core/dataset/region_masks.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "core/dataset/mesh_parts.h"
#include "core/dataset/registered_depth.h"
#include "core/dataset/silhouette.h"
#include "tests/unit/dataset/scanned_scene.h"

namespace scantrove::test {
namespace {

struct Refined {
  ViewOfMap map;
  MeasuredView measured;
  cv::Mat regions;
  float focal_px = 0;

  explicit Refined(ScannedScene& scene, int index = 0, bool with_color = true) {
    const std::vector<KeyFrameInfo> frames = *scene.keyFrames(false);
    for (const KeyFrameInfo& frame : frames) {
      if (frame.index != index) continue;
      map = *scene.renderView(frame.K_color, frame.colorCameraPose());
      measured.depth_m = registerDepth(frame, *scene.depth(index));
      if (with_color) measured.color = *scene.color(index);
      focal_px = frame.K_color.fx;
    }
    regions = refineRegions(map, measured, focal_px);
  }
  [[nodiscard]] cv::Mat of(std::uint32_t id) const { return regions == static_cast<int>(id); }
  [[nodiscard]] cv::Mat before(std::uint32_t id) const { return map.regions == static_cast<int>(id); }
};

// The map of these tests is coarse, 2 mm too thick and 4 mm off; depth is noisy, at half of colour's
// resolution.
TEST(RefineRegions, FollowsMeasuredDepthAndColor) {
  ScannedScene scene;
  for (const int frame : {0, 10, 20}) {
    const Refined refined(scene, frame);
    for (const std::uint32_t id : {kBox, kBall, kBlock}) {
      const cv::Mat exact = scene.exactMask(frame, id);
      const std::string key = std::to_string(frame) + "_" + std::to_string(id);
      RecordProperty("map_" + key, std::to_string(iou(refined.before(id), exact)));
      RecordProperty("refined_" + key, std::to_string(iou(refined.of(id), exact)));
      EXPECT_GE(iou(refined.of(id), exact), id == kBlock ? 0.97 : 0.985) << id << " in frame " << frame;
      EXPECT_GE(iou(refined.of(id), exact), iou(refined.before(id), exact)) << "not worse than the map alone";
    }
  }
}

TEST(RefineRegions, IsNearlyAsAccurate_WithDepthAlone) {
  ScannedScene scene;
  const Refined refined(scene, 0, false);
  for (const std::uint32_t id : {kBox, kBall})
    EXPECT_GE(iou(refined.of(id), scene.exactMask(0, id)), 0.95) << id;
}

TEST(RefineRegions, KeepsAnExactMap) {
  ScannedScene scene;
  scene.faults = {.voxel_m = 0, .swollen_m = 0, .shift_m = Eigen::Vector3d::Zero()};
  const Refined refined(scene);
  for (const std::uint32_t id : {kBox, kBall, kTable})
    EXPECT_GE(iou(refined.of(id), scene.exactMask(0, id)), 0.98) << id;
}

TEST(RefineRegions, SmoothsVoxelStepsInOutlines) {
  // Voxels are four pixels high here: an outline with their steps is longer than the true one.
  ScannedScene scene;
  scene.faults.voxel_m = 0.006;
  const Refined refined(scene);
  const auto length = [](const cv::Mat& mask) {
    cv::Mat across, down;
    cv::absdiff(mask.colRange(1, mask.cols), mask.colRange(0, mask.cols - 1), across);
    cv::absdiff(mask.rowRange(1, mask.rows), mask.rowRange(0, mask.rows - 1), down);
    return cv::countNonZero(across) + cv::countNonZero(down);
  };
  for (const std::uint32_t id : {kBox, kBall})
    EXPECT_LT(length(refined.of(id)), 1.15 * length(scene.exactMask(0, id))) << id;
}

TEST(RefineRegions, LeavesNoSmallComponents_WithNoisyDepth) {
  ScannedScene scene;
  scene.depth_noise_px = 0.5;  // six times a Kinect's, so outliers reach the tolerance
  for (const int frame : {0, 20}) {
    const Refined refined(scene, frame);
    for (const std::uint32_t id : {kTable, kBox, kBall, kBlock}) {
      cv::Mat parts, stats, centers;
      const int count = cv::connectedComponentsWithStats(refined.of(id), parts, stats, centers, 4);
      int small_components = 0;
      for (int part = 1; part < count; ++part)
        small_components += stats.at<int>(part, cv::CC_STAT_AREA) < 8 ? 1 : 0;
      RecordProperty("small_components_" + std::to_string(frame) + "_" + std::to_string(id),
                     small_components);
      EXPECT_EQ(small_components, 0) << id << " in frame " << frame;
    }
  }
}

TEST(RefineRegions, IsUnlabeled_WhereAnUnmappedObjectOccludes) {
  // Depth contains a hand 20 cm before the camera; the map does not.
  ScannedScene scene;
  Refined refined(scene);
  const cv::Rect hand(280, 200, 60, 60);
  refined.measured.depth_m(hand) = 0.2F;
  const cv::Mat regions = refineRegions(refined.map, {refined.measured.depth_m, {}}, refined.focal_px);
  EXPECT_EQ(cv::countNonZero(regions(hand)), 0);
  EXPECT_GT(cv::countNonZero(refined.regions(hand)), 3000);
}

TEST(RefineRegions, OpensNoGaps_WhenDepthIsMixedAtEdges) {
  // Time-of-flight cameras return the mean of both depths at an edge.
  ScannedScene scene;
  Refined refined(scene);
  const cv::Mat exact =
      Shapes().renderView(scene.K_color, scene.poseOf(0) * scene.T_color_depth.inverse()).depth_m;
  cv::Mat low, high;
  cv::erode(exact, low, cv::Mat());
  cv::dilate(exact, high, cv::Mat());
  cv::Mat mixed = 0.5 * low + 0.5 * high;
  exact.copyTo(mixed, high - low < 0.05F);
  const cv::Mat regions = refineRegions(refined.map, {mixed, refined.measured.color}, refined.focal_px);
  EXPECT_LT(cv::countNonZero((regions == 0) & (refined.map.regions != 0)), 200)
      << "1400 if mixed depths were taken for a surface";
  for (const std::uint32_t id : {kBox, kBall})
    EXPECT_GE(iou(regions == static_cast<int>(id), scene.exactMask(0, id)), 0.96) << id;
}

TEST(RefineRegions, KeepsTheMap_WithoutDepth) {
  ScannedScene scene;
  const Refined refined(scene);
  const cv::Mat nothing = cv::Mat::zeros(refined.map.regions.size(), CV_32FC1);
  const cv::Mat regions = refineRegions(refined.map, {nothing, {}}, refined.focal_px);
  // Except for corners of voxels that stick out of the surface, one or two pixels each.
  EXPECT_LT(cv::countNonZero(regions != refined.map.regions), 0.001 * static_cast<double>(regions.total()));
}

/// A plane at 2 m with one region in the middle of another.
struct FlatView {
  ViewOfMap map{cv::Mat(120, 160, CV_32SC1, cv::Scalar(1)), cv::Mat(120, 160, CV_32FC1, cv::Scalar(2))};
  MeasuredView measured{cv::Mat(120, 160, CV_32FC1, cv::Scalar(2)), {}};
  static constexpr float kFocal_px = 130;
  static inline const cv::Rect kPatch{40, 30, 80, 60};

  FlatView() { map.regions(kPatch) = 2; }
  [[nodiscard]] cv::Mat refined() const { return refineRegions(map, measured, kFocal_px); }
};

TEST(RefineRegions, KeepsARegionWhoseDepthIsBiased) {
  FlatView view;
  view.measured.depth_m(FlatView::kPatch) = 2.035F;  // more than the noise of map and camera at 2 m
  EXPECT_EQ(cv::countNonZero(view.refined() != view.map.regions), 0);
}

TEST(RefineRegions, LeavesOutWhatHidesARegion) {
  FlatView view;
  const cv::Rect hand(60, 40, 40, 30);
  view.measured.depth_m(hand) = 1.5F;
  const cv::Mat regions = view.refined();
  EXPECT_EQ(cv::countNonZero(regions(hand) != 0), 0);
  EXPECT_EQ(regions.at<int>(35, 45), 2);
}

TEST(RefineRegions, FillsAHoleThatNoDepthShows) {
  FlatView view;
  const cv::Rect screen(60, 40, 30, 20);
  view.map.regions(screen) = 0;
  view.map.depth_m(screen) = 0;
  view.measured.depth_m(screen) = 0;
  EXPECT_EQ(cv::countNonZero(view.refined()(FlatView::kPatch) != 2), 0);
}

TEST(RefineRegions, LeavesAHoleThatTheCameraSeesThrough) {
  FlatView view;
  const cv::Rect handle(60, 40, 30, 20);
  view.map.regions(handle) = 0;
  view.map.depth_m(handle) = 0;
  view.measured.depth_m(handle) = 2.6F;
  EXPECT_EQ(cv::countNonZero(view.refined()(handle) != 0), 0);
}

TEST(Silhouette, IncludesOccludedParts) {
  ScannedScene scene;
  const KeyFrameInfo frame = scene.keyFrames(false)->front();
  const auto parts = splitByRegion(*scene.mesh(), scene.labels);
  for (const std::uint32_t id : {kBox, kBall}) {
    const Silhouette silhouette = silhouetteOf(parts.at(id), frame.K_color, frame.colorCameraPose());
    const cv::Mat exact = scene.exactMask(0, id, true);
    EXPECT_GE(iou(silhouette.mask(exact.size()), exact), 0.98)
        << id << ": a ball of 24 rings is slightly smaller";
    EXPECT_EQ(silhouette.pixels, cv::countNonZero(silhouette.mask(exact.size())))
        << "the object is entirely in the image";
    EXPECT_EQ(silhouette.tightBox(), boxOf(silhouette.mask(exact.size())));
  }
}

TEST(Silhouette, ExtendsBeyondTheImage) {
  ScannedScene scene;
  const KeyFrameInfo frame = scene.keyFrames(false)->front();
  const auto parts = splitByRegion(*scene.mesh(), scene.labels);
  const Silhouette complete = silhouetteOf(parts.at(kBox), frame.K_color, frame.colorCameraPose());
  Intrinsics half = frame.K_color;  // the image ends in the middle of the box
  half.cx -= static_cast<float>(complete.tightBox().x + complete.tightBox().width / 2);
  const Silhouette silhouette = silhouetteOf(parts.at(kBox), half, frame.colorCameraPose());
  EXPECT_NEAR(silhouette.pixels, complete.pixels, 0.01 * complete.pixels);
  EXPECT_LT(silhouette.tightBox().x, 0);
  const int inside = cv::countNonZero(silhouette.mask({half.width, half.height}));
  EXPECT_GT(inside, 0.3 * complete.pixels);
  EXPECT_LT(inside, 0.7 * complete.pixels);
  Eigen::Isometry3d away = frame.colorCameraPose();
  away.linear().col(0) *= -1;
  away.linear().col(2) *= -1;
  EXPECT_TRUE(silhouetteOf(parts.at(kBox), half, away).empty()) << "behind the camera";
}

}  // namespace
}  // namespace scantrove::test
