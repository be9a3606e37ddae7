#include "core/dataset/export_sample.h"

#include "tests/unit/dataset/exported.h"

namespace scantrove::test {
namespace {

/// Pixels where two pictures differ clearly: those drawn over in one of them.
cv::Mat difference(const cv::Mat& a, const cv::Mat& b) {
  cv::Mat channels, sum;
  cv::absdiff(a, b, channels);
  cv::transform(channels, sum, cv::Matx13f(1, 1, 1));
  return sum > 40;
}

TEST(ExportSample, ShowsTheExportedMasksOverTheColorImage) {
  ScannedScene scene;
  const auto sample = sampleExport(scene, {.format = DatasetFormat::coco, .folder = {}}, 1);
  ASSERT_TRUE(sample) << sample.error().message();
  EXPECT_EQ(sample->count, 3);
  EXPECT_EQ(sample->index, 1);
  EXPECT_EQ(sample->frame, 10);
  EXPECT_EQ(sample->masks, 2);
  EXPECT_TRUE(sample->problem.empty());
  const cv::Mat plain = *scene.color(10);
  ASSERT_EQ(sample->picture.size(), plain.size());
  const cv::Mat drawn = difference(sample->picture, plain);
  const cv::Mat requested = scene.exactMask(10, kBox) | scene.exactMask(10, kBall);
  EXPECT_GT(iou(drawn, requested), 0.85);
}

TEST(ExportSample, FollowsFormatBackgroundAndPosition) {
  ScannedScene scene;
  const auto more =
      sampleExport(scene, {.format = DatasetFormat::masks, .folder = {}, .background = true}, 0);
  ASSERT_TRUE(more);
  EXPECT_EQ(more->masks, 4) << "with the table and the block";
  const auto middle = sampleExport(scene, {.format = DatasetFormat::yolo, .folder = {}}, std::nullopt);
  ASSERT_TRUE(middle);
  EXPECT_EQ(middle->index, 1);
  const auto beyond = sampleExport(scene, {.format = DatasetFormat::yolo, .folder = {}}, 99);
  ASSERT_TRUE(beyond);
  EXPECT_EQ(beyond->index, 2);
  const auto mesh = sampleExport(scene, {.format = DatasetFormat::mesh, .folder = {}}, 0);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->count, 0);
  EXPECT_TRUE(mesh->picture.empty());
}

TEST(ExportSample, ShowsDepth_WithoutColor_WhenTheFormatAllowsIt) {
  ScannedScene scene;
  scene.without_color = {0, 10, 20};
  const auto masks = sampleExport(scene, {.format = DatasetFormat::masks, .folder = {}}, 0);
  ASSERT_TRUE(masks);
  EXPECT_EQ(masks->picture.size(), cv::Size(320, 240));
  EXPECT_EQ(masks->masks, 2);
  const auto coco = sampleExport(scene, {.format = DatasetFormat::coco, .folder = {}}, 0);
  ASSERT_TRUE(coco);
  EXPECT_EQ(coco->count, 0);
}

TEST(ExportSample, NamesTheFile_WhenAnImageIsDamaged) {
  ScannedScene scene;
  scene.with_damaged_depth = {10};
  const auto sample = sampleExport(scene, {.format = DatasetFormat::coco, .folder = {}}, 1);
  ASSERT_TRUE(sample);
  EXPECT_TRUE(sample->picture.empty());
  EXPECT_NE(sample->problem.find("depth-10.png"), std::string::npos);
  scene.map_is_damaged = true;
  EXPECT_FALSE(sampleExport(scene, {.format = DatasetFormat::coco, .folder = {}}, 0));
}

}  // namespace
}  // namespace scantrove::test
