#include "core/dataset/painted_masks.h"

#include <gtest/gtest.h>

#include "core/dataset/export_sample.h"
#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

/// 20 x 10 pixels: region 1 in the left half, region 2 in the right one.
cv::Mat twoRegions() {
  cv::Mat regions(10, 20, CV_32SC1, cv::Scalar::all(1));
  regions.colRange(10, 20).setTo(2);
  return regions;
}

cv::Mat maskOf(const cv::Rect& box) {
  cv::Mat mask = cv::Mat::zeros(10, 20, CV_8UC1);
  mask(box).setTo(255);
  return mask;
}

PaintedMask painted(std::uint32_t region, const cv::Rect& added, const cv::Rect& removed = {}) {
  return {.region = region, .added = maskOf(added), .removed = maskOf(removed)};
}

bool isAll(const cv::Mat& regions, int region) { return cv::countNonZero(regions != region) == 0; }

TEST(PaintedMasks, TakePixelsFromOtherRegions) {
  cv::Mat regions = twoRegions();
  applyPaintedMasks(std::vector{painted(1, {8, 2, 6, 4})}, regions);
  EXPECT_TRUE(isAll(regions(cv::Rect(8, 2, 6, 4)), 1));
  EXPECT_EQ(cv::countNonZero(regions == 2), 100 - 4 * 4);
}

TEST(PaintedMasks, LaterOnesHold_WhereTheyOverlap) {
  cv::Mat regions = twoRegions();
  applyPaintedMasks(
      std::vector{painted(1, {8, 2, 6, 4}), painted(3, {12, 2, 4, 4}), painted(2, {}, {15, 0, 1, 1})},
      regions);
  EXPECT_TRUE(isAll(regions(cv::Rect(8, 2, 4, 4)), 1));
  EXPECT_TRUE(isAll(regions(cv::Rect(12, 2, 4, 4)), 3));
}

TEST(PaintedMasks, RemovedPixelsTakeTheRegionAroundThem) {
  cv::Mat regions = twoRegions();
  applyPaintedMasks(std::vector{painted(1, {}, {7, 0, 6, 10})}, regions);
  EXPECT_EQ(cv::countNonZero(regions == 1), 70);
  EXPECT_EQ(cv::countNonZero(regions == 2), 130) << "pixels of region 2 are not touched";
}

TEST(PaintedMasks, RemovedPixelsAreUnlabelled_WhenTheirRegionEnclosesThem) {
  cv::Mat regions = twoRegions();
  applyPaintedMasks(std::vector{painted(1, {}, {3, 3, 4, 4})}, regions);
  EXPECT_TRUE(isAll(regions(cv::Rect(3, 3, 4, 4)), 0));
  EXPECT_EQ(cv::countNonZero(regions == 1), 84);
}

TEST(PaintedMasks, KeepPartsThatWereSplitFromTheirRegionSince) {
  cv::Mat regions = twoRegions();
  PaintedMask mask = painted(3, {5, 0, 10, 10});
  mask.parts = {2};
  applyPaintedMasks(std::vector{mask}, regions);
  EXPECT_EQ(cv::countNonZero(regions == 3), 50);
  EXPECT_EQ(cv::countNonZero(regions == 2), 100);
}

TEST(PaintedMasks, AreLeftOut_WhenTheirSizeDiffers) {
  cv::Mat regions = twoRegions();
  const cv::Mat small(5, 5, CV_8UC1, cv::Scalar::all(255));
  applyPaintedMasks(std::vector{PaintedMask{.region = 9, .added = small, .removed = small}}, regions);
  EXPECT_EQ(cv::countNonZero(regions != twoRegions()), 0);
}

/// In image 10, the ball was painted over a square of the table.
class PaintedScene : public ScannedScene {
 public:
  [[nodiscard]] std::vector<PaintedMask> paintedMasks(int index) override {
    if (index != 10) return {};
    const cv::Size size(K_color.width, K_color.height);
    PaintedMask ball{
        .region = kBall, .added = cv::Mat::zeros(size, CV_8UC1), .removed = cv::Mat::zeros(size, CV_8UC1)};
    ball.added(square).setTo(255);
    return {ball};
  }
  const cv::Rect square{20, 400, 40, 40};
};

TEST(PaintedMasks, AreInTheMasksOfTheirImageAlone) {
  PaintedScene scene;
  scene.frames = 2;
  const TemporaryFolder home;
  const auto summary = exportDataset(scene, {.format = DatasetFormat::masks, .folder = home / "out"});
  ASSERT_TRUE(summary) << summary.error().message();
  const auto masksOf = [&](const char* name) {
    return cv::imread((home / "out/masks" / name).string(), cv::IMREAD_UNCHANGED);
  };
  EXPECT_EQ(cv::countNonZero(masksOf("000010.png")(scene.square) == static_cast<int>(kBall)), 1600)
      << "unrefined";
  EXPECT_EQ(cv::countNonZero(masksOf("000000.png")(scene.square) == static_cast<int>(kBall)), 0);
}

TEST(PaintedMasks, AreInThePreview) {
  PaintedScene scene;
  ScannedScene plain;
  const ExportOptions options{.format = DatasetFormat::coco, .folder = "unused"};
  const auto painted_sample = sampleExport(scene, options, 1);
  const auto sample = sampleExport(plain, options, 1);
  ASSERT_TRUE(painted_sample && sample);
  ASSERT_EQ(painted_sample->frame, 10);
  cv::Mat difference;
  cv::absdiff(painted_sample->picture, sample->picture, difference);
  EXPECT_GT(cv::countNonZero(difference.reshape(1)(cv::Rect(3 * 20, 400, 3 * 40, 40))), 3 * 1000);
}

}  // namespace
}  // namespace scantrove::test
