#include "core/picture/render_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "core/capture/video_frames.h"
#include "core/picture/surface_renderer.h"
#include "core/picture/video_writer.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/picture/cube_scan.h"

namespace scantrove::test {
namespace {

using testing::HasSubstr;

std::size_t entriesOf(const TemporaryFolder& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.path()),
                                                std::filesystem::directory_iterator()));
}

int coveredPixels(const cv::Mat& image) {
  return static_cast<int>(std::count_if(image.begin<cv::Vec3b>(), image.end<cv::Vec3b>(),
                                        [](const cv::Vec3b& pixel) { return pixel != kPictureBackground; }));
}

Result<void> renderCubes(const RenderOptions& options) {
  CubeScan scan;
  return renderScan(scan, options, {}, {});
}

TEST(RenderFile, WritesAPictureOfTheRequestedSize) {
  const TemporaryFolder folder;
  const auto done =
      renderCubes({.file = folder / "cubes.png", .width = 320, .height = 200, .elevation_deg = 0});
  ASSERT_TRUE(done) << done.error().message();
  const cv::Mat image = cv::imread(folder / "cubes.png", cv::IMREAD_COLOR);
  ASSERT_EQ(image.size(), cv::Size(320, 200));
  EXPECT_EQ(image.at<cv::Vec3b>(100, 160), kPictureBackground);  // the gap between the cubes is in the middle
  EXPECT_EQ(entriesOf(folder), 1U);
}

TEST(RenderFile, FramesTheObject_WhenOneIsRequested) {
  const TemporaryFolder folder;
  ASSERT_TRUE(renderCubes({.file = folder / "all.png", .width = 200, .height = 200}));
  ASSERT_TRUE(renderCubes({.file = folder / "mug.png", .object = "mug", .width = 200, .height = 200}));
  const cv::Mat all = cv::imread(folder / "all.png"), mug = cv::imread(folder / "mug.png");
  EXPECT_NE(mug.at<cv::Vec3b>(100, 100), kPictureBackground);
  EXPECT_GT(coveredPixels(mug), 2 * coveredPixels(all));
  const auto missing = renderCubes({.file = folder / "cup.png", .object = "cup"});
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message(), HasSubstr("'cup'"));
  EXPECT_EQ(entriesOf(folder), 2U);
}

TEST(PictureScene, ColorsObjectsAndRegions) {
  CubeScan scan;
  const auto regions = makePictureScene(scan, PictureColors::regions, "");
  ASSERT_TRUE(regions) << regions.error().message();
  ASSERT_EQ(regions->surface.face_colors.size(), 24U);
  EXPECT_EQ(regions->surface.face_colors.front(), regionColor(RegionId{3}));
  EXPECT_EQ(regions->surface.face_colors.back(), regionColor(RegionId{5}));
  const auto objects = makePictureScene(scan, PictureColors::objects, "");
  ASSERT_TRUE(objects);
  EXPECT_EQ(objects->surface.face_colors.front(), regionColor(RegionId{3}));
  // Green in grey is 0.587 * 255.
  EXPECT_EQ(objects->surface.face_colors.back(), (Rgb{149, 149, 149}));
  const auto own = makePictureScene(scan, PictureColors::rgb, "mug");
  ASSERT_TRUE(own);
  EXPECT_TRUE(own->surface.face_colors.empty());
  EXPECT_EQ(own->surface.vertices.size(), 8U);
  EXPECT_EQ(own->surface.vertices.front().color, (Rgb{0, 255, 0}));
  EXPECT_GT(own->up_world.z(), 0.99F);  // the camera is upright, and the cube's top is level
  EXPECT_LT(own->front_world.y(), -0.99F);
}

TEST(RenderFile, WritesAVideoThatOpensAgain) {
  const TemporaryFolder folder;
  const auto done = renderCubes({.file = folder / "cubes.webm",
                                 .object = "mug",
                                 .width = 160,
                                 .height = 96,
                                 .seconds = 0.5,
                                 .frames_per_second = 24});
  ASSERT_TRUE(done) << done.error().message();
  VideoFrames video(folder / "cubes.webm");
  for (int i = 0; i < 12; ++i) {
    const auto frame = video.frame(i);
    ASSERT_TRUE(frame) << i << ": " << frame.error().message();
    EXPECT_EQ(frame->size(), cv::Size(160, 96));
    const cv::Vec3b middle = frame->at<cv::Vec3b>(48, 80);
    EXPECT_GT(middle[1], middle[0] + 60) << "green, in frame " << i;
  }
  EXPECT_FALSE(video.frame(12));
  EXPECT_EQ(entriesOf(folder), 1U);
}

TEST(VideoWriter, KeepsColors) {
  const TemporaryFolder folder;
  auto video = VideoWriter::create(folder / "grey.webm", 64, 48, 10);
  ASSERT_TRUE(video) << video.error().message();
  for (const int grey : {40, 120, 200})
    ASSERT_TRUE(video->add(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(grey))));
  ASSERT_TRUE(video->finish());
  VideoFrames frames(folder / "grey.webm");
  for (int i = 0; i < 3; ++i) {
    const auto frame = frames.frame(i);
    ASSERT_TRUE(frame) << frame.error().message();
    EXPECT_NEAR(cv::mean(*frame)[0], 40 + 80 * i, 5);  // the loss of the compression
  }
}

TEST(RenderFile, LeavesWhatExists) {
  const TemporaryFolder folder;
  folder.write("mine.png", "mine");
  const auto refused = renderCubes({.file = folder / "mine.png"});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message(), HasSubstr("exists already"));
  EXPECT_EQ(readText(folder / "mine.png"), "mine");
  EXPECT_EQ(entriesOf(folder), 1U);
}

TEST(RenderFile, LeavesNothing_WhenCancelled) {
  const TemporaryFolder folder;
  std::stop_source stop;
  CubeScan scan;
  int drawn = 0;
  const auto done = renderScan(
      scan, {.file = folder / "cubes.webm", .width = 64, .height = 64},
      [&](int, int) {
        if (++drawn == 3) stop.request_stop();
      },
      stop.get_token());
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message(), HasSubstr("cancelled"));
  EXPECT_EQ(drawn, 3);
  EXPECT_EQ(entriesOf(folder), 0U);
}

TEST(RenderFile, RefusesOtherFilesAndSizes) {
  EXPECT_EQ(renderFrameCount({.file = "a.png"}), 1);
  EXPECT_EQ(renderFrameCount({.file = "a.webm", .seconds = 2, .frames_per_second = 25}), 50);
  EXPECT_FALSE(renderFrameCount({.file = "a.gif"}));
  EXPECT_FALSE(renderFrameCount({.file = "a.png", .width = 15}));
  EXPECT_FALSE(renderFrameCount({.file = "a.png", .height = 8193}));
  EXPECT_FALSE(renderFrameCount({.file = "a.webm", .seconds = 1e9}));
  EXPECT_FALSE(renderFrameCount({.file = "a.png", .elevation_deg = 91}));
  const auto missing = renderCubes({.file = "/nonexistent/a.png"});
  ASSERT_FALSE(missing);
  EXPECT_THAT(missing.error().message(), HasSubstr("/nonexistent/a.png"));
}

}  // namespace
}  // namespace scantrove::test
